import { IsostarError } from '../api/errors.js';
import type { Feed } from '../input/feed.js';
import type { OpenOptions, Reply, Report, Request } from './protocol.js';

/** One call of decode(), or the worker's start. */
export class Call {
  /** The source of the call, if it has one. */
  feed: Feed | undefined;
  #failure: { readonly reason: unknown } | undefined;
  readonly #waiting: { resolve(reply: Reply): void; reject(reason: unknown): void }[] = [];

  /** Resolves to the next reply of the worker that no earlier call waits for. */
  async reply(): Promise<Reply> {
    if (this.#failure) throw this.#failure.reason;
    const reply = await new Promise<Reply>((resolve, reject) => {
      this.#waiting.push({ resolve, reject });
    });
    if (reply.type !== 'failed') return reply;
    throw reply.code ? new IsostarError(reply.code, reply.message) : new Error(reply.message);
  }

  accept(message: Reply | Report): void {
    if (message.type === 'taken') this.feed?.taken(message.weight);
    else if (message.type === 'wanted') this.feed?.want(message.ranges);
    else if (message.type === 'enough') this.feed?.stop();
    else this.#waiting.shift()?.resolve(message);
  }

  /** A pending reply() and all later ones throw `reason`; the first reason counts. */
  fail(reason: unknown): void {
    this.#failure ??= { reason };
    for (const { reject } of this.#waiting.splice(0)) reject(reason);
  }

  throwIfFailed(): void {
    if (this.#failure) throw this.#failure.reason;
  }
}

/** A worker and the calls that it serves. */
export class WorkerLink {
  readonly #worker: Worker;
  readonly #calls = new Map<number, Call>();
  readonly #onLost: () => void;
  #isOpen = false;
  #end: { readonly reason: unknown } | undefined; // why no more replies will come

  private constructor(worker: Worker, onLost: () => void) {
    this.#worker = worker;
    this.#onLost = onLost;
    worker.onmessage = ({ data }: MessageEvent<Reply | Report>) =>
      this.#calls.get(data.id)?.accept(data);
    worker.onerror = (event) => {
      event.preventDefault(); // it is reported as an IsostarError
      this.#lose(event.message);
    };
    worker.onmessageerror = () => this.#lose('a message could not be read');
  }

  /** Starts a worker of this package. `onLost` is called if it ends by itself. */
  static async open(
    start: () => Worker,
    options: OpenOptions,
    onLost: () => void,
  ): Promise<WorkerLink> {
    const link = new WorkerLink(started(start), onLost);
    try {
      const call = link.begin(0);
      link.post({ type: 'open', id: 0, ...options });
      await call.reply();
    } catch (reason) {
      link.close(reason);
      throw reason;
    }
    link.end(0);
    link.#isOpen = true;
    return link;
  }

  begin(id: number): Call {
    const call = new Call();
    if (this.#end) call.fail(this.#end.reason);
    else this.#calls.set(id, call);
    return call;
  }

  end(id: number): void {
    this.#calls.delete(id);
  }

  post(request: Request, transfer: Transferable[] = []): void {
    if (!this.#end) this.#worker.postMessage(request, transfer);
  }

  /** Ends the worker. All calls throw `reason`. */
  close(reason: unknown): void {
    if (this.#end) return;
    this.#end = { reason };
    this.#worker.terminate();
    for (const call of this.#calls.values()) call.fail(reason);
    this.#calls.clear();
  }

  #lose(message: string | undefined): void {
    const words = message ? ` (${message})` : '';
    this.close(
      this.#isOpen
        ? new IsostarError('OverLimit', `the decoder's worker was lost${words}`)
        : new IsostarError('BadArgument', `the decoder's worker cannot be loaded${words}`),
    );
    this.#onLost();
  }
}

function started(start: () => Worker): Worker {
  try {
    return start();
  } catch (reason) {
    const { message } = reason as Error;
    throw new IsostarError('BadArgument', `the decoder's worker cannot be started (${message})`);
  }
}
