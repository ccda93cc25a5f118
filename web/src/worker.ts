import { IsostarError } from './api/errors.js';
import { InboxDecoder } from './codec/inbox-decoder.js';
import { loadModule } from './codec/load-module.js';
import { Modules } from './codec/modules.js';
import type { WholeSurface } from './codec/surface-chunks.js';
import { Inbox } from './input/inbox.js';
import { HeldShare } from './remote/held-share.js';
import { Helpers } from './remote/helpers.js';
import type { OpenOptions, Reply, Report, Request } from './remote/protocol.js';

interface Port {
  postMessage(message: Reply | Report, transfer?: Transferable[]): void;
  onmessage: ((event: MessageEvent<Request>) => void) | null;
}

interface Decode {
  readonly inbox: Inbox;
  readonly surfaces: AsyncGenerator<WholeSurface, void>;
}

/**
 * The decoder behind a port, of a page or of a worker that this one helps. It decodes when `next`
 * or `advance` is requested; until then it collects bytes.
 */
class Service {
  readonly #port: Port;
  #modules: Modules | undefined;
  #decoder: InboxDecoder | undefined;
  readonly #decodes = new Map<number, Decode>();
  readonly #shares = new Map<number, HeldShare>();

  constructor(port: Port) {
    this.#port = port;
    port.onmessage = ({ data }) => void this.#handle(data);
  }

  #handle(request: Request): void | Promise<void> {
    const { type, id } = request;
    if (type === 'open') return this.#reply(0, () => this.#open(request));
    if (type === 'decode') return void this.#decodes.set(id, this.#begin(request));
    if (type === 'share') return void this.#shares.set(id, this.#beginShare(request));
    const decode = this.#decodes.get(id);
    if (decode) return this.#pass(request, decode);
    const share = this.#shares.get(id);
    if (share) return this.#passToShare(request, share);
  }

  async #open({ wasm, helpers = 0 }: OpenOptions): Promise<Reply> {
    const loaded = await loadModule(wasm);
    this.#modules = await Modules.of(loaded);
    const workers = new Helpers(loaded.compiled, helpers);
    this.#decoder = new InboxDecoder(this.#modules, (...share) => workers.begin(...share));
    return { type: 'opened', id: 0 };
  }

  #begin({ id, options }: Extract<Request, { type: 'decode' }>): Decode {
    const inbox = new Inbox({
      taken: (weight) => this.#port.postMessage({ type: 'taken', id, weight }),
      wanted: (ranges) => this.#port.postMessage({ type: 'wanted', id, ranges }),
      enough: () => this.#port.postMessage({ type: 'enough', id }),
    });
    return { inbox, surfaces: this.#decoder!.decode(inbox, options) };
  }

  #beginShare({ options, share, all }: Extract<Request, { type: 'share' }>): HeldShare {
    const modules = this.#modules!;
    return new HeldShare(
      all ? modules.leaseAll(all) : modules.lease(options.polygonizer),
      options,
      share,
    );
  }

  async #pass(request: Request, { inbox, surfaces }: Decode): Promise<void> {
    const { type, id } = request;
    if (type === 'accept') inbox.accept(request.piece);
    if (type === 'finish') inbox.finish();
    if (type === 'beginIsovalues') inbox.beginIsovalues();
    if (type === 'setIsovalue') inbox.setIsovalue(request.isovalue);
    if (type === 'endIsovalues') inbox.endIsovalues();
    if (type === 'next') return this.#reply(id, () => this.#next(id, surfaces));
    if (type === 'stop') {
      this.#decodes.delete(id);
      inbox.fail(new DOMException('stopped', 'AbortError'));
      await surfaces.return().catch(() => {});
    }
  }

  async #passToShare(request: Request, share: HeldShare): Promise<void> {
    const { type, id } = request;
    if (type === 'accept') share.accept(request.piece);
    if (type === 'finish') share.finish();
    if (type === 'advance')
      return this.#reply(id, async () => {
        return { type: 'results', id, results: await share.advance(request.results) };
      });
    if (type === 'results')
      return this.#reply(id, async () => ({ type, id, results: await share.results() }));
    if (type === 'mesh')
      return this.#reply(id, async () => {
        return { type: 'part', id, part: await share.mesh(request.results, request.isovalue) };
      });
    if (type === 'stop') {
      this.#shares.delete(id);
      share.delete();
    }
  }

  async #next(id: number, surfaces: AsyncGenerator<WholeSurface, void>): Promise<Reply> {
    const { value } = await surfaces.next();
    return value ? { type: 'surface', id, surface: value } : { type: 'done', id };
  }

  async #reply(id: number, work: () => Promise<Reply>): Promise<void> {
    try {
      const reply = await work();
      this.#port.postMessage(reply, buffersOf(reply));
    } catch (reason) {
      const code = reason instanceof IsostarError ? reason.code : undefined;
      const message = String((reason as Error)?.message ?? reason);
      this.#port.postMessage({ type: 'failed', id, code, message });
    }
  }
}

/** What a reply gives away. */
function buffersOf(reply: Reply): ArrayBuffer[] {
  if (reply.type === 'results') return reply.results ? [reply.results.buffer] : [];
  const mesh = reply.type === 'surface' ? reply.surface : reply.type === 'part' && reply.part;
  return mesh ? [mesh.positions.buffer, mesh.normals.buffer, mesh.indices.buffer] : [];
}

// Outside a worker an import must have no effect.
if ('WorkerGlobalScope' in globalThis) new Service(globalThis as unknown as Port);
