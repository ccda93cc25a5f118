/** The ES module that Emscripten writes; web/build.mjs states where it is. */
declare module 'isostar-wasm' {
  const createModule: (options: {
    wasmBinary: ArrayBufferView | ArrayBuffer;
  }) => Promise<import('./raw.js').RawModule>;
  export default createModule;
}
