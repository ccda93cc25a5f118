import { IsostarError } from '../api/errors.js';
import { embindModule } from './embind-module.js';
import { isPlain, plainModule } from './plain-module.js';
import type { RawModule } from './raw.js';

/**
 * The decoder's WebAssembly: its address or its bytes. By default `decoder.wasm` beside this
 * package's scripts and, for streams that this one lacks, `decoder-all.wasm`.
 */
export type WasmSource = URL | string | BufferSource;

/** The decoder's WebAssembly, compiled. */
export interface LoadedModule {
  readonly compiled: WebAssembly.Module;
  instantiate(): Promise<RawModule>;
  /** The module for streams that this one lacks. */
  loadAll(): Promise<LoadedModule>;
}

/** Compiles the WebAssembly, unless another thread has done so. */
export async function loadModule(wasm?: WasmSource | WebAssembly.Module): Promise<LoadedModule> {
  if (wasm instanceof WebAssembly.Module) return loadedModule(wasm);
  if (wasm) return compile(wasm);
  const own = await compile(new URL('./decoder.wasm', import.meta.url)); // in dist/
  const loadAll = () => compile(new URL('./decoder-all.wasm', import.meta.url));
  return { ...own, loadAll };
}

async function compile(wasm: WasmSource): Promise<LoadedModule> {
  const isAddress = wasm instanceof URL || typeof wasm === 'string';
  const name = isAddress ? String(wasm) : 'the bytes given as `wasm`';
  const bytes = isAddress ? await readAddress(wasm) : wasm;
  if (!hasMagic(bytes)) throw notUsable(name, 'not a WebAssembly module');
  const compiled = await WebAssembly.compile(bytes).catch((reason) => {
    throw notUsable(name, `cannot be compiled (${messageOf(reason)})`);
  });
  return loadedModule(compiled, name);
}

/** `name`: for messages. */
export function loadedModule(
  compiled: WebAssembly.Module,
  name = 'the module of another worker',
): LoadedModule {
  return {
    compiled,
    async instantiate() {
      try {
        return await (isPlain(compiled) ? plainModule : embindModule)(compiled);
      } catch (reason) {
        if (reason instanceof RangeError)
          throw new IsostarError('OverLimit', `no memory for the decoder (${messageOf(reason)})`);
        throw notUsable(name, `not the WebAssembly of this isostar (${messageOf(reason)})`);
      }
    },
    async loadAll() {
      throw notUsable(name, 'lacks what this stream or its options need; use decoder-all.wasm');
    },
  };
}

const notUsable = (name: string, what: string) =>
  new IsostarError('BadArgument', `${name}: ${what}`);

const messageOf = (reason: unknown) => String((reason as Error)?.message ?? reason);

async function readAddress(address: URL | string): Promise<BufferSource> {
  const read = String(address).startsWith('file:') ? readFile(new URL(address)) : fetch(address);
  const content = await read.catch((reason) => {
    throw notUsable(String(address), messageOf(reason));
  });
  if (content instanceof Uint8Array) return content;
  const { ok, status, statusText } = content;
  if (!ok) throw notUsable(String(address), `HTTP status ${status} ${statusText}`.trim());
  return content.arrayBuffer();
}

/**
 * Node's fetch does not read files. The module's name is a parameter so that bundlers for browsers
 * do not try to resolve it.
 */
async function readFile(
  address: URL,
  module = 'node:fs/promises',
): Promise<Uint8Array<ArrayBuffer>> {
  const files = (await import(
    /* webpackIgnore: true */ /* @vite-ignore */ module
  )) as typeof import('node:fs/promises');
  return (await files.readFile(address)) as Uint8Array<ArrayBuffer>;
}

/** Some servers answer a wrong path with status 200 and a page. */
function hasMagic(bytes: BufferSource): boolean {
  const head = ArrayBuffer.isView(bytes)
    ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength)
    : new Uint8Array(bytes);
  return head[0] === 0 && head[1] === 0x61 && head[2] === 0x73 && head[3] === 0x6d;
}
