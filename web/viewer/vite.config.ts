import { defineConfig } from 'vite';

export default defineConfig({
  root: import.meta.dirname,
  base: './', // the built page works from any folder of any server
  build: {
    outDir: '../../build/viewer',
    emptyOutDir: true,
    target: 'es2022',
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 1000,
  },
  worker: { format: 'es' },
  optimizeDeps: { exclude: ['isostar'] }, // pre-bundling would lose its worker and its wasm
});
