import { IsostarError } from './errors.js';
import { Inbox } from './inbox.js';
import { LocalDecoder } from './local-decoder.js';
import type { Reply, Request } from './protocol.js';
import type { Surface } from './surface.js';

interface Port {
  postMessage(reply: Reply, transfer: Transferable[]): void;
  onmessage: ((event: MessageEvent<Request>) => void) | null;
}

/** A decoder at the other end of a port: decodes when asked for the next surface, until then only collects bytes. */
class Service {
  readonly #port: Port;
  #decoder: LocalDecoder | undefined;
  readonly #decodes = new Map<number, { inbox: Inbox; surfaces: AsyncGenerator<Surface, void> }>();

  constructor(port: Port) {
    this.#port = port;
    port.onmessage = ({ data }) => void this.#obey(data);
  }

  async #obey(request: Request): Promise<void> {
    if (request.type === 'open') return this.#answer(0, () => this.#open(request.wasm));
    if (request.type === 'decode') {
      const inbox = new Inbox();
      this.#decodes.set(request.id, { inbox, surfaces: this.#decoder!.decodeInbox(inbox, request.options) });
      return;
    }
    const decode = this.#decodes.get(request.id);
    if (!decode) return;
    if (request.type === 'piece') decode.inbox.push(request.piece);
    if (request.type === 'end') decode.inbox.end();
    if (request.type === 'turn') decode.inbox.turn(request.isovalue);
    if (request.type === 'settle') decode.inbox.settle();
    if (request.type === 'next') return this.#answer(request.id, () => this.#next(request.id, decode.surfaces));
    if (request.type === 'stop') {
      this.#decodes.delete(request.id);
      decode.inbox.fail(new DOMException('stopped', 'AbortError'));
      await decode.surfaces.return().catch(() => {});
    }
  }

  async #open(wasm: Extract<Request, { type: 'open' }>['wasm']): Promise<Reply> {
    this.#decoder = await LocalDecoder.create(wasm);
    return { type: 'opened', id: 0 };
  }

  async #next(id: number, surfaces: AsyncGenerator<Surface, void>): Promise<Reply> {
    const { value } = await surfaces.next();
    return value ? { type: 'surface', id, surface: value } : { type: 'done', id };
  }

  async #answer(id: number, work: () => Promise<Reply>): Promise<void> {
    try {
      const reply = await work();
      this.#port.postMessage(reply, reply.type === 'surface' ? buffersOf(reply.surface) : []);
    } catch (reason) {
      const code = reason instanceof IsostarError ? reason.code : undefined;
      this.#port.postMessage({ type: 'failed', id, code, message: String((reason as Error)?.message ?? reason) }, []);
    }
  }
}

const buffersOf = ({ positions, normals, indices }: Surface) => [positions.buffer, normals.buffer, indices.buffer];

// Only a worker may be served: elsewhere an import must have no effect.
if ('WorkerGlobalScope' in globalThis) new Service(globalThis as unknown as Port);
