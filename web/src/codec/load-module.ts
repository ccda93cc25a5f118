import createModule from 'isostar-wasm';
import { IsostarError } from '../api/errors.js';
import type { RawModule } from './raw.js';

/**
 * The decoder's WebAssembly: its address or its bytes; by default `decoder.wasm` beside this
 * package's scripts.
 */
export type WasmSource = URL | string | BufferSource;

/** Returns a new instance on every call. */
export async function loadModule(
  wasm: WasmSource = new URL('./decoder.wasm', import.meta.url), // relative to the bundle in dist/
): Promise<RawModule> {
  const isAddress = wasm instanceof URL || typeof wasm === 'string';
  const bytes = isAddress ? await readAddress(wasm) : wasm;
  checkMagic(bytes, isAddress ? String(wasm) : 'the bytes given as `wasm`');
  return createModule({ wasmBinary: bytes });
}

async function readAddress(address: URL | string): Promise<BufferSource> {
  if (String(address).startsWith('file:')) return readFile(new URL(address));
  const response = await fetch(address);
  if (!response.ok)
    throw new IsostarError(
      'BadArgument',
      `${address}: HTTP status ${response.status} ${response.statusText}`.trim(),
    );
  return response.arrayBuffer();
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
function checkMagic(bytes: BufferSource, name: string): void {
  const head = ArrayBuffer.isView(bytes)
    ? new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength)
    : new Uint8Array(bytes);
  if (head[0] !== 0 || head[1] !== 0x61 || head[2] !== 0x73 || head[3] !== 0x6d)
    throw new IsostarError('BadArgument', `${name}: not a WebAssembly module`);
}
