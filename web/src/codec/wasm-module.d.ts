/** The ES module that Emscripten writes; web/build.mjs states where it is. */
declare module 'isostar-wasm' {
  const createModule: (options: {
    /** Instantiates the WebAssembly with `imports`; may call `receive` later. */
    instantiateWasm(
      imports: WebAssembly.Imports,
      receive: (instance: WebAssembly.Instance) => void,
    ): object;
    printErr(message: string): void;
  }) => Promise<import('./raw.js').RawModule>;
  export default createModule;
}
