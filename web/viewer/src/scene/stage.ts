import {
  Box3,
  Fog,
  NeutralToneMapping,
  Scene,
  Sphere,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { Camera } from './camera.ts';
import { studioLights } from './lighting.ts';
import { Pane, type Shape } from './pane.ts';
import { Wireframes } from './wireframes.ts';

const BACKGROUND = '#0d1014';

/** The 3D view: two panes with one camera and the same lights, drawn only after a change. */
export class Stage {
  readonly #canvas: HTMLCanvasElement;
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #fog = new Fog(BACKGROUND);
  readonly #camera: Camera;
  readonly #scale = { value: 1 };
  readonly #panes: readonly [Pane, Pane];
  #isSplit = true;
  #isDue = false;

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    this.#renderer = new WebGLRenderer({
      canvas,
      antialias: true,
      alpha: true,
      powerPreference: 'high-performance',
    });
    this.#renderer.toneMapping = NeutralToneMapping;
    this.#renderer.toneMappingExposure = 1.05;
    this.#camera = new Camera(canvas, () => this.invalidate());
    const wireframes = new Wireframes();
    this.#panes = [
      new Pane('#e9dcc3', this.#scale, wireframes),
      new Pane('#c3d0de', this.#scale, wireframes),
    ];
    this.#camera.eye.add(studioLights());
    this.#scene.fog = this.#fog;
    this.#scene.add(this.#camera.eye, ...this.#panes.map((pane) => pane.group));
    new ResizeObserver(() => this.#resize()).observe(canvas);
  }

  /** Resolves when the shaders are compiled. */
  async warm(): Promise<void> {
    const canWait = this.#renderer.extensions.has('KHR_parallel_shader_compile');
    if (canWait) await this.#renderer.compileAsync(this.#scene, this.#camera.eye);
    else this.#renderer.compile(this.#scene, this.#camera.eye);
  }

  show(pane: 0 | 1, shape: Shape | undefined): void {
    this.#panes[pane].show(shape);
    this.invalidate();
    void this.#drawEdges();
  }

  /** Points the camera at a new subject. */
  frame(shape: Shape, orbit: readonly [number, number]): void {
    const { center, radius } = sphereOf(shape);
    this.#scale.value = radius;
    this.#camera.setSubject(center, radius);
    this.#camera.fit(orbit);
    this.invalidate();
  }

  /** After a refinement: the surface of the first levels may have been much smaller. */
  follow(shape: Shape): void {
    const { center, radius } = sphereOf(shape);
    this.#camera.follow(center, radius);
    this.#scale.value = Math.max(this.#scale.value, radius);
    this.invalidate();
  }

  fit(): void {
    this.#camera.fit();
    this.invalidate();
  }

  setSplit(isSplit: boolean): void {
    this.#isSplit = isSplit;
    this.#resize();
  }

  setWireframe(on: boolean): void {
    for (const pane of this.#panes) pane.setWireframe(on);
    void this.#drawEdges();
    this.invalidate();
  }

  /** Gives each chunk of the first pane's surface a colour. */
  setColouring(on: boolean): void {
    this.#panes[0].setColouring(on);
    void this.#drawEdges();
    this.invalidate();
  }

  invalidate(): void {
    if (this.#isDue) return;
    this.#isDue = true;
    requestAnimationFrame(() => this.#draw());
  }

  async #drawEdges(): Promise<void> {
    for (const pane of this.#panes) if (await pane.drawEdges()) this.invalidate();
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    const ratio = Math.min(devicePixelRatio, 2);
    const { x, y } = this.#renderer.getSize(new Vector2());
    if (x !== width || y !== height || ratio !== this.#renderer.getPixelRatio())
      this.#renderer.setDrawingBufferSize(width, height, ratio);
    this.#camera.setAspect((this.#isSplit ? width / 2 : width) / height);
    this.#draw();
  }

  #draw(): void {
    this.#isDue = false;
    this.#camera.update();
    [this.#fog.near, this.#fog.far] = this.#camera.depthRange();
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    const shown = this.#isSplit ? this.#panes : [this.#panes[0]];
    this.#renderer.setScissorTest(true);
    shown.forEach((pane, i) => {
      for (const other of this.#panes)
        other.group.visible = other === pane && pane.shape !== undefined;
      const share = width / shown.length;
      this.#renderer.setViewport(i * share, 0, share, height);
      this.#renderer.setScissor(i * share, 0, share, height);
      this.#renderer.render(this.#scene, this.#camera.eye);
    });
  }
}

/** An approximation from at most 10,000 vertices. */
function sphereOf({ positions }: Shape): Sphere {
  const box = new Box3();
  const stride = 3 * Math.ceil(positions.length / 30_000);
  const point = new Vector3();
  for (let i = 0; i < positions.length; i += stride)
    box.expandByPoint(point.fromArray(positions, i));
  return box.isEmpty() ? new Sphere(new Vector3(), 1) : box.getBoundingSphere(new Sphere());
}
