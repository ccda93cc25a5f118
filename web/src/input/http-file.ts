import { IsostarError } from '../api/errors.js';
import type { ByteRange } from './byte-ranges.js';
import type { Part, RangeFile } from './range-file.js';

/** How a RangeSource makes its requests. */
export interface HttpOptions {
  headers?: HeadersInit | undefined;
  /** As of `fetch`. */
  credentials?: RequestCredentials | undefined;
  /** Called instead of the global `fetch`. */
  fetch?: typeof fetch | undefined;
}

/** A file on a server, read by range requests. */
export class HttpFile implements RangeFile {
  readonly #address: string;
  readonly #options: HttpOptions;
  #tag: string | undefined;
  #length: number | undefined;

  constructor(address: string, options: HttpOptions) {
    this.#address = address;
    this.#options = options;
  }

  get length(): number | undefined {
    return this.#length;
  }

  async open(range: ByteRange, signal: AbortSignal): Promise<Part> {
    const response = await this.#request(range, signal);
    try {
      return this.#part(response, range);
    } catch (reason) {
      void response.body?.cancel().catch(() => {});
      throw reason;
    }
  }

  // Without If-Range: it would cost pages a preflight, and a server that knows it would send all of
  // a file that changed.
  #request({ begin, end }: ByteRange, signal: AbortSignal): Promise<Response> {
    const { headers, credentials, fetch: request = globalThis.fetch } = this.#options;
    const init: RequestInit = { headers: new Headers(headers), signal };
    (init.headers as Headers).set('Range', `bytes=${begin}-${end - 1}`);
    if (credentials) init.credentials = credentials;
    return request(this.#address, init);
  }

  #part(response: Response, range: ByteRange): Part {
    if (response.status !== 200 && response.status !== 206)
      throw badStatus(response, this.#address);
    this.#tag = this.#same(this.#tag, response.headers.get('ETag') ?? undefined);
    const body = response.body ?? new Blob().stream();
    if (response.status === 200) return { begin: 0, end: undefined, body };
    // Servers elsewhere may not let pages read it; the checksums of the stream must do then.
    const field = response.headers.get('Content-Range');
    if (field === null) return { ...range, body };
    const [, first, last, length] = /^bytes (\d+)-(\d+)\/(\d+|\*)$/i.exec(field) ?? [];
    if (length !== '*') this.#length = this.#same(this.#length, Number(length));
    const end = Math.min(range.end, this.#length ?? Infinity);
    if (Number(first) !== range.begin || Number(last) !== end - 1)
      throw new IsostarError(
        'BadArgument',
        `${this.#address}: the server was asked for bytes ${range.begin}-${range.end - 1}` +
          ` and answered with "${field}"`,
      );
    return { begin: range.begin, end, body };
  }

  /** What an answer states, which must be what earlier ones have stated. */
  #same<Value>(before: Value | undefined, now: Value | undefined): Value | undefined {
    if (before !== undefined && now !== undefined && before !== now)
      throw new IsostarError('Corrupt', `${this.#address}: the file changed while it was read`);
    return now ?? before;
  }
}

export function badStatus({ status, statusText }: Response, address: string): IsostarError {
  return new IsostarError('BadArgument', `${address}: HTTP status ${status} ${statusText}`.trim());
}
