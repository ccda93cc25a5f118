import { IsostarError } from './api/errors.js';
import type { Surface } from './api/surface.js';
import { InboxDecoder } from './codec/inbox-decoder.js';
import { Inbox } from './input/inbox.js';
import type { Reply, Report, Request } from './remote/protocol.js';

interface Port {
  postMessage(message: Reply | Report, transfer?: Transferable[]): void;
  onmessage: ((event: MessageEvent<Request>) => void) | null;
}

interface Decode {
  readonly inbox: Inbox;
  readonly surfaces: AsyncGenerator<Surface, void>;
}

/** The decoder behind a port. It decodes when `next` is requested; until then it collects bytes. */
class Service {
  readonly #port: Port;
  #decoder: InboxDecoder | undefined;
  readonly #decodes = new Map<number, Decode>();

  constructor(port: Port) {
    this.#port = port;
    port.onmessage = ({ data }) => void this.#handle(data);
  }

  async #handle(request: Request): Promise<void> {
    if (request.type === 'open') return this.#reply(0, () => this.#open(request.wasm));
    if (request.type === 'decode') {
      const { id } = request;
      const inbox = new Inbox({
        taken: (weight) => this.#port.postMessage({ type: 'taken', id, weight }),
        wanted: (ranges) => this.#port.postMessage({ type: 'wanted', id, ranges }),
        enough: () => this.#port.postMessage({ type: 'enough', id }),
      });
      const surfaces = this.#decoder!.decode(inbox, request.options);
      this.#decodes.set(id, { inbox, surfaces });
      return;
    }
    const decode = this.#decodes.get(request.id);
    if (!decode) return;
    const { inbox, surfaces } = decode;
    if (request.type === 'accept') inbox.accept(request.piece);
    if (request.type === 'finish') inbox.finish();
    if (request.type === 'beginIsovalues') inbox.beginIsovalues();
    if (request.type === 'setIsovalue') inbox.setIsovalue(request.isovalue);
    if (request.type === 'endIsovalues') inbox.endIsovalues();
    if (request.type === 'next')
      return this.#reply(request.id, () => this.#next(request.id, surfaces));
    if (request.type === 'stop') {
      this.#decodes.delete(request.id);
      inbox.fail(new DOMException('stopped', 'AbortError'));
      await surfaces.return().catch(() => {});
    }
  }

  async #open(wasm: Extract<Request, { type: 'open' }>['wasm']): Promise<Reply> {
    this.#decoder = await InboxDecoder.create(wasm);
    return { type: 'opened', id: 0 };
  }

  async #next(id: number, surfaces: AsyncGenerator<Surface, void>): Promise<Reply> {
    const { value } = await surfaces.next();
    return value ? { type: 'surface', id, surface: value } : { type: 'done', id };
  }

  async #reply(id: number, work: () => Promise<Reply>): Promise<void> {
    try {
      const reply = await work();
      this.#port.postMessage(reply, reply.type === 'surface' ? buffersOf(reply.surface) : []);
    } catch (reason) {
      const code = reason instanceof IsostarError ? reason.code : undefined;
      const message = String((reason as Error)?.message ?? reason);
      this.#port.postMessage({ type: 'failed', id, code, message });
    }
  }
}

const buffersOf = ({ positions, normals, indices }: Surface) => [
  positions.buffer,
  normals.buffer,
  indices.buffer,
];

// Outside a worker an import must have no effect.
if ('WorkerGlobalScope' in globalThis) new Service(globalThis as unknown as Port);
