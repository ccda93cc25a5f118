/** The ES module that Emscripten writes; web/build.mjs says where it is. */
declare module 'isostar-wasm' {
  const createModule: (options: { wasmBinary: ArrayBufferView | ArrayBuffer }) => Promise<import('./raw.js').RawModule>;
  export default createModule;
}
