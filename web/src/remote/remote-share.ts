import type { MeshPart } from '../codec/mesh-part.js';
import type { OtherShare } from '../codec/team.js';
import type { Piece } from '../input/pieces.js';
import type { Reply, ShareOptions, ShareRequest } from './protocol.js';
import type { Call, WorkerLink } from './worker-link.js';

/** A share of a stream that another worker decodes. */
export class RemoteShare implements OtherShare {
  readonly #link: WorkerLink;
  readonly #id: number;
  readonly #call: Call;

  constructor(link: WorkerLink, id: number, options: ShareOptions) {
    this.#link = link;
    this.#id = id;
    this.#call = link.begin(id);
    link.post({ type: 'share', id, ...options });
  }

  accept(piece: Piece): void {
    this.#link.post({ type: 'accept', id: this.#id, piece });
  }

  finish(): void {
    this.#link.post({ type: 'finish', id: this.#id });
  }

  advance(results: readonly Uint8Array[]): Promise<Uint8Array | undefined> {
    return this.#resultsOf({ type: 'advance', id: this.#id, results });
  }

  results(): Promise<Uint8Array | undefined> {
    return this.#resultsOf({ type: 'results', id: this.#id });
  }

  async mesh(results: readonly Uint8Array[], isovalue: number): Promise<MeshPart> {
    const reply = await this.#request({ type: 'mesh', id: this.#id, results, isovalue });
    return (reply as Extract<Reply, { type: 'part' }>).part;
  }

  end(): void {
    this.#link.post({ type: 'stop', id: this.#id });
    this.#link.end(this.#id);
  }

  async #resultsOf(request: ShareRequest): Promise<Uint8Array | undefined> {
    return ((await this.#request(request)) as Extract<Reply, { type: 'results' }>).results;
  }

  #request(request: ShareRequest): Promise<Reply> {
    const reply = this.#call.reply();
    this.#link.post(request);
    return reply;
  }
}
