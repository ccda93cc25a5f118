import type { Polygonizer, Surface } from 'isostar';
import { Draco } from './draco/draco.ts';
import { Download, fromAddress, type Origin } from './stream/download.ts';
import { idle, nextFrame } from './idle.ts';
import { IsovalueSlider } from './panel/isovalue-slider.ts';
import type { Sample } from './stream/samples.ts';
import { Side } from './panel/side.ts';
import { Stage } from './scene/stage.ts';
import { Statistics } from './panel/statistics.ts';
import { Timeline } from './panel/timeline.ts';
import { Track } from './stream/track.ts';

const ORBIT: readonly [number, number] = [-32, 12];
const UPDATE_INTERVAL = 80; // milliseconds between two updates of the transfers' figures

const element = <E extends HTMLElement>(selector: string): E =>
  document.querySelector<E>(selector)!;

/** Loads a stream, and Draco's file beside it, and shows both with their figures. */
export class Viewer {
  readonly stage = new Stage(element<HTMLCanvasElement>('#picture'));
  readonly #statistics = new Statistics(
    element<HTMLTableElement>('#statistics'),
    element('#headline'),
  );
  readonly #isostarSide = new Side('isostar', this.#statistics);
  readonly #dracoSide = new Side('draco', this.#statistics);
  readonly #timeline = new Timeline(element('#timeline'), (bytes) => this.#track.scrub(bytes));
  readonly #isovalues = new IsovalueSlider(element('#isovalue'), (isovalue) =>
    this.#track.setIsovalue(isovalue),
  );
  readonly #track = new Track({
    surface: (surface, isLive) => this.#show(surface, isLive),
    failure: (reason) => this.showMessage(reasonOf(reason)),
  });
  readonly #draco = new Draco();
  #origin: Origin | undefined;
  #sample: Sample | undefined;
  #bitsPerSecond = Infinity;
  #isComparing = true;
  #isFramed = false;
  #run = 0;

  constructor() {
    setInterval(() => this.#update(), UPDATE_INTERVAL);
  }

  /** Loads a stream, and Draco's file of the same surface if the sample has one. */
  async play(origin: Origin, sample?: Sample): Promise<void> {
    this.#origin = origin;
    this.#sample = sample;
    this.#isFramed = false;
    element('#note').textContent = sample?.note ?? '';
    await this.replay();
  }

  async replay(): Promise<void> {
    const origin = this.#origin;
    if (!origin) return;
    const run = ++this.#run;
    this.showMessage('');
    this.#timeline.clear();
    this.#isovalues.clear();
    this.stage.show(0, undefined);
    this.stage.show(1, undefined);
    this.#arrange();
    // The times of both sides exclude the download of their decoders.
    await Promise.all([
      this.stage.warm(),
      this.#track.ready(),
      this.#isSplit && this.#draco.ready(),
    ]);
    if (run !== this.#run) return;
    const begin = performance.now();
    const draco = this.#isSplit ? this.#sample?.draco : undefined;
    const download = new Download(origin, this.#bitsPerSecond);
    this.#isostarSide.begin(begin, download);
    this.#dracoSide.begin(
      begin,
      draco && new Download(fromAddress(draco.file), this.#bitsPerSecond),
    );
    this.#track.play(download);
    this.#compare();
    if (draco) await this.#playDraco(run);
  }

  setRate(bitsPerSecond: number): void {
    this.#bitsPerSecond = bitsPerSecond;
  }

  setPolygonizer(polygonizer: Polygonizer): void {
    this.#track.setPolygonizer(polygonizer);
  }

  setComparing(isComparing: boolean): void {
    this.#isComparing = isComparing;
    if (this.#isSplit && !this.#dracoSide.download) void this.replay();
    else this.#arrange();
  }

  /** A line for the user; an empty one removes it. */
  showMessage(text: string): void {
    element('#message').textContent = text;
    element('#message').hidden = text === '';
  }

  get #isSplit(): boolean {
    return this.#isComparing && this.#sample?.draco !== undefined;
  }

  #arrange(): void {
    document.body.classList.toggle('single', !this.#isSplit);
    element('[data-role=settings]').textContent = this.#sample?.draco?.settings ?? '';
    this.stage.setSplit(this.#isSplit);
    this.stage.fit();
  }

  #show(surface: Surface, isLive: boolean): void {
    this.stage.show(0, surface);
    this.#frame(surface);
    this.#timeline.show(surface, isLive);
    this.#isovalues.show(surface);
    this.#update();
    const { info, milliseconds } = surface;
    element('#chunks').hidden = info.chunkSide === 0;
    this.#isostarSide.addFigures({
      bytes: surface.bytes,
      sourceVertices: info.vertices,
      error: surface.error,
      level: `${surface.level + 1} of ${surface.levels}`,
      vertices: surface.positions.length / 3,
      triangles: surface.indices.length / 3,
      decode: milliseconds.decode,
      polygonize: milliseconds.polygonize,
    });
    element('#status').textContent =
      `Level ${surface.level + 1} of ${surface.levels}${surface.final ? ', complete' : ''}`;
    if (isLive) void this.#time(surface);
  }

  async #time({ final }: Surface): Promise<void> {
    const { first, complete } = this.#isostarSide.figures;
    if (first !== undefined && (!final || complete !== undefined)) return;
    const run = this.#run;
    await nextFrame();
    if (run !== this.#run) return;
    const now = this.#isostarSide.elapsed();
    this.#isostarSide.addFigures({
      first: first ?? now,
      ...(final && { complete: complete ?? now }),
    });
    this.#compare();
  }

  async #playDraco(run: number): Promise<void> {
    try {
      const bytes = await this.#dracoSide.download!.whole();
      const surface = await this.#draco.decode(bytes);
      await idle();
      if (run !== this.#run) return;
      this.stage.show(1, surface);
      await nextFrame();
      const now = this.#dracoSide.elapsed();
      this.#dracoSide.addFigures({
        bytes: bytes.length,
        sourceVertices: this.#isostarSide.figures.sourceVertices,
        error: this.#sample?.draco?.error,
        vertices: surface.positions.length / 3,
        triangles: surface.indices.length / 3,
        first: now,
        complete: now,
        decode: surface.milliseconds.decode,
        polygonize: surface.milliseconds.normals,
      });
      this.#compare();
    } catch (reason) {
      if (run === this.#run) this.showMessage(reasonOf(reason));
    }
  }

  #compare(): void {
    const sizes = this.#sample?.draco && {
      isostar: this.#sample.bytes,
      draco: this.#sample.draco.bytes,
    };
    this.#statistics.compare(
      this.#isSplit ? sizes : undefined,
      this.#isostarSide.figures.first,
      this.#dracoSide.figures.first,
    );
  }

  /** Sets the camera once per subject; a replay does not move it. */
  #frame(surface: Surface): void {
    if (surface.positions.length === 0) return;
    if (this.#isFramed) return this.stage.follow(surface);
    this.#isFramed = true;
    this.stage.frame(surface, this.#sample?.orbit ?? ORBIT);
  }

  #update(): void {
    this.#isostarSide.update();
    this.#dracoSide.update();
    if (this.#isostarSide.download)
      this.#timeline.receive(this.#isostarSide.download.length, this.#isostarSide.download.total);
  }
}

const reasonOf = (reason: unknown) => (reason instanceof Error ? reason.message : String(reason));
