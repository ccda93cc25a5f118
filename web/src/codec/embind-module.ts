import type { RawModule } from './raw.js';

/** The default export of the ES module that Emscripten writes beside decoder-all.wasm. */
type CreateModule = (options: {
  /** Instantiates the WebAssembly with `imports`; may call `receive` later. */
  instantiateWasm(
    imports: WebAssembly.Imports,
    receive: (instance: WebAssembly.Instance) => void,
  ): object;
  printErr(message: string): void;
}) => Promise<RawModule>;

/**
 * Instantiates the module that decodes everything. Its script is not part of a bundle, which would
 * be larger for it, but a file beside it, as the WebAssembly is.
 */
export async function embindModule(compiled: WebAssembly.Module): Promise<RawModule> {
  const script = new URL('./decoder-all.js', import.meta.url); // in dist/
  const { default: createModule } = (await import(
    /* webpackIgnore: true */ /* @vite-ignore */ script.href
  )) as { default: CreateModule };
  return new Promise((resolve, reject) => {
    createModule({
      // Emscripten's own way would abort, and write to the console, instead of throwing.
      instantiateWasm(imports, receive) {
        WebAssembly.instantiate(compiled, imports).then(receive).catch(reject);
        return {};
      },
      printErr() {}, // an abort is reported as an IsostarError
    }).then((raw) => (raw.Decoder ? resolve(raw) : reject(new Error('no Decoder'))), reject);
  });
}
