import type { Polygonizer, Surface } from 'isostar';
import { Draco } from './draco.ts';
import { Download, fromAddress, type Origin } from './download.ts';
import { idle, nextPicture } from './idle.ts';
import { IsovalueSlider } from './isovalue-slider.ts';
import type { Sample } from './samples.ts';
import { Side } from './side.ts';
import { Stage } from './stage.ts';
import { Statistics } from './statistics.ts';
import { Timeline } from './timeline.ts';
import { Track } from './track.ts';

const ORBIT: readonly [number, number] = [-32, 12];
const TICK = 80;  // milliseconds between two looks at the transfers

const element = <E extends HTMLElement>(selector: string): E => document.querySelector<E>(selector)!;

/** What is loaded, how it comes along, and what is shown of it. */
export class Viewer {
  readonly stage = new Stage(element<HTMLCanvasElement>('#picture'));
  readonly #statistics = new Statistics(element<HTMLTableElement>('#statistics'), element('#headline'));
  readonly #ours = new Side('isostar', this.#statistics);
  readonly #theirs = new Side('draco', this.#statistics);
  readonly #timeline = new Timeline(element('#timeline'), (bytes) => this.#track.scrub(bytes));
  readonly #isovalues = new IsovalueSlider(element('#isovalue'), (isovalue) => this.#track.turn(isovalue));
  readonly #track = new Track({
    surface: (surface, isLive) => this.#show(surface, isLive),
    failure: (reason) => this.say(reasonOf(reason)),
  });
  readonly #draco = new Draco();
  #origin: Origin | undefined;
  #sample: Sample | undefined;
  #bitsPerSecond = Infinity;
  #isComparing = true;
  #isFramed = false;
  #contest = 0;

  constructor() {
    setInterval(() => this.#tick(), TICK);
  }

  /** Loads a stream, and what Draco makes of the same surface where the sample has it. */
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
    const contest = ++this.#contest;
    this.say('');
    this.#timeline.clear();
    this.#isovalues.clear();
    this.stage.show(0, undefined);
    this.stage.show(1, undefined);
    this.#arrange();
    // Neither side's time counts the download of its decoder.
    await Promise.all([this.stage.warm(), this.#track.ready(), this.#isSplit && this.#draco.ready()]);
    if (contest !== this.#contest) return;
    const begin = performance.now();
    const draco = this.#isSplit ? this.#sample?.draco : undefined;
    const download = new Download(origin, this.#bitsPerSecond);
    this.#ours.begin(begin, download);
    this.#theirs.begin(begin, draco && new Download(fromAddress(draco.file), this.#bitsPerSecond));
    this.#track.play(download);
    this.#compare();
    if (draco) await this.#playDraco(contest);
  }

  setRate(bitsPerSecond: number): void {
    this.#bitsPerSecond = bitsPerSecond;
  }

  setPolygonizer(polygonizer: Polygonizer): void {
    this.#track.setPolygonizer(polygonizer);
  }

  setComparing(isComparing: boolean): void {
    this.#isComparing = isComparing;
    if (this.#isSplit && !this.#theirs.download) void this.replay();
    else this.#arrange();
  }

  /** A line for the person; none takes the last away. */
  say(text: string): void {
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
    this.#tick();
    const { info, milliseconds } = surface;
    this.#ours.learn({
      bytes: surface.bytes,
      sourceVertices: info.vertices,
      error: surface.error,
      level: `${surface.level + 1} of ${surface.levels}`,
      vertices: surface.positions.length / 3,
      triangles: surface.indices.length / 3,
      decode: milliseconds.decode,
      polygonize: milliseconds.polygonize,
    });
    element('#status').textContent = `Level ${surface.level + 1} of ${surface.levels}${surface.final ? ', complete' : ''}`;
    if (isLive) void this.#time(surface);
  }

  async #time({ final }: Surface): Promise<void> {
    const { first, complete } = this.#ours.figures;
    if (first !== undefined && (!final || complete !== undefined)) return;
    const contest = this.#contest;
    await nextPicture();
    if (contest !== this.#contest) return;
    const now = this.#ours.elapsed();
    this.#ours.learn({ first: first ?? now, ...(final && { complete: complete ?? now }) });
    this.#compare();
  }

  async #playDraco(contest: number): Promise<void> {
    try {
      const bytes = await this.#theirs.download!.whole();
      const surface = await this.#draco.decode(bytes);
      await idle();
      if (contest !== this.#contest) return;
      this.stage.show(1, surface);
      await nextPicture();
      const now = this.#theirs.elapsed();
      this.#theirs.learn({
        bytes: bytes.length,
        sourceVertices: this.#ours.figures.sourceVertices,
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
      if (contest === this.#contest) this.say(reasonOf(reason));
    }
  }

  #compare(): void {
    const sizes = this.#sample?.draco && { isostar: this.#sample.bytes, draco: this.#sample.draco.bytes };
    this.#statistics.compare(this.#isSplit ? sizes : undefined, this.#ours.figures.first, this.#theirs.figures.first);
  }

  /** The camera is set once a subject: a replay leaves it where it is. */
  #frame(surface: Surface): void {
    if (surface.positions.length === 0) return;
    if (this.#isFramed) return this.stage.follow(surface);
    this.#isFramed = true;
    this.stage.frame(surface, this.#sample?.orbit ?? ORBIT);
  }

  #tick(): void {
    this.#ours.tick();
    this.#theirs.tick();
    if (this.#ours.download) this.#timeline.receive(this.#ours.download.length, this.#ours.download.total);
  }
}

const reasonOf = (reason: unknown) => (reason instanceof Error ? reason.message : String(reason));
