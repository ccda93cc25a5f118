import {
  BufferGeometry,
  DirectionalLight,
  DoubleSide,
  HemisphereLight,
  MathUtils,
  Mesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  Spherical,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { Surface } from '../api/surface.js';
import { showSurface } from '../three.js';

export interface ViewSettings {
  readonly isInteractive: boolean;
  readonly isRotating: boolean;
  /** Azimuth, angle from the pole, distance: `30deg 80deg 100%`. */
  readonly orbit: string | undefined;
  readonly color: string;
}

const KEY_STEP = MathUtils.degToRad(8);

/** Draws a surface into the element's canvas. The world's z axis points up. */
export class SurfaceView {
  readonly #canvas: HTMLCanvasElement;
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #camera = new PerspectiveCamera(30, 1);
  readonly #controls: OrbitControls;
  readonly #geometry = new BufferGeometry();
  readonly #material = new MeshStandardMaterial({ roughness: 0.65, side: DoubleSide });
  readonly #resizes: ResizeObserver;
  readonly #onKey = (event: KeyboardEvent) => this.#handleKey(event);
  #orbit: string | undefined;
  #isFramed = false;
  #isDue = false;

  constructor(canvas: HTMLCanvasElement, onCameraChange: () => void) {
    this.#canvas = canvas;
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#camera.up.set(0, 0, 1);
    const key = new DirectionalLight('#fff3e0', 2.4);
    key.position.set(-2, 3, 3);
    this.#camera.add(key, key.target, new HemisphereLight('#dfe8ff', '#40362e', 1.1));
    this.#scene.add(this.#camera, new Mesh(this.#geometry, this.#material));
    this.#controls = new OrbitControls(this.#camera, canvas);
    this.#controls.enabled = false;
    this.#controls.addEventListener('change', () => {
      this.#invalidate();
      onCameraChange();
    });
    canvas.addEventListener('keydown', this.#onKey);
    this.#resizes = new ResizeObserver(() => this.#resize());
    this.#resizes.observe(canvas);
  }

  configure({ isInteractive, isRotating, orbit, color }: ViewSettings): void {
    this.#controls.enabled = isInteractive;
    this.#canvas.style.touchAction = isInteractive ? 'none' : 'auto';
    this.#controls.autoRotate =
      isRotating && !matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.#material.color.set(color);
    if (orbit !== this.#orbit) this.#isFramed = false;
    this.#orbit = orbit;
    this.#frame();
    this.#invalidate();
  }

  /** The next surface is of another stream. */
  expectNewSubject(): void {
    this.#isFramed = false;
  }

  show(surface: Surface): void {
    showSurface(this.#geometry, surface);
    this.#frame();
    this.#invalidate();
  }

  dispose(): void {
    this.#resizes.disconnect();
    this.#canvas.removeEventListener('keydown', this.#onKey);
    this.#controls.dispose();
    this.#geometry.dispose();
    this.#material.dispose();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss(); // browsers allow about sixteen contexts
  }

  /** Shows the whole grid, once per stream: later refinements do not move the camera. */
  #frame(): void {
    const sphere = this.#geometry.boundingSphere;
    if (this.#isFramed || !sphere) return;
    this.#isFramed = true;
    const [azimuth = 30, polar = 80, distance = 100] = (this.#orbit ?? '')
      .split(/\s+/)
      .filter(Boolean)
      .map(Number.parseFloat);
    const narrow =
      Math.min(1, this.#camera.aspect) * Math.tan(MathUtils.degToRad(this.#camera.fov / 2));
    const radius = (sphere.radius / Math.sin(Math.atan(narrow))) * (distance / 100) * 0.75;
    this.#controls.target.copy(sphere.center);
    this.#placeCamera(
      new Spherical(radius, MathUtils.degToRad(polar), MathUtils.degToRad(azimuth)),
    );
    this.#camera.near = sphere.radius / 50;
    this.#camera.far = sphere.radius * 50;
    this.#camera.updateProjectionMatrix();
  }

  #handleKey(event: KeyboardEvent): void {
    const turns: Record<string, [number, number, number]> = {
      ArrowLeft: [-1, 0, 1],
      ArrowRight: [1, 0, 1],
      ArrowUp: [0, -1, 1],
      ArrowDown: [0, 1, 1],
      '+': [0, 0, 1 / 1.1],
      '-': [0, 0, 1.1],
    };
    const turn = turns[event.key];
    if (!turn || !this.#controls.enabled) return;
    event.preventDefault();
    const { x, y, z } = this.#camera.position.clone().sub(this.#controls.target);
    const offset = new Spherical().setFromCartesianCoords(x, z, -y);
    offset.theta += turn[0] * KEY_STEP;
    offset.phi += turn[1] * KEY_STEP;
    offset.radius *= turn[2];
    this.#placeCamera(offset.makeSafe());
  }

  // Spherical has y up, the camera z.
  #placeCamera(offset: Spherical): void {
    const { x, y, z } = new Vector3().setFromSpherical(offset);
    this.#camera.position.copy(this.#controls.target).add(new Vector3(x, -z, y));
    this.#controls.update();
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.setSize(width, height, false);
    this.#camera.aspect = width / height;
    this.#camera.updateProjectionMatrix();
    this.#draw();
  }

  #invalidate(): void {
    if (this.#isDue) return;
    this.#isDue = true;
    requestAnimationFrame(() => this.#draw());
  }

  #draw(): void {
    this.#isDue = false;
    if (this.#controls.autoRotate) this.#controls.update();
    this.#renderer.render(this.#scene, this.#camera);
  }
}
