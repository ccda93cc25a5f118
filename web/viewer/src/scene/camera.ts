import { MathUtils, PerspectiveCamera, Spherical, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

const KEY_STEP = MathUtils.degToRad(6);
const GROWTH = 1.05; // a smaller growth does not move the camera
const reducedMotion = matchMedia('(prefers-reduced-motion: reduce)');

/** One camera for both panes. The world's z axis points up, as in scanners. */
export class Camera {
  readonly eye = new PerspectiveCamera(26, 1, 0.1, 1e5);
  readonly #controls: OrbitControls;
  #center = new Vector3();
  #radius = 1;
  /** Has the user moved it since the last fit()? */
  #isMoved = false;

  constructor(canvas: HTMLElement, onChange: () => void) {
    this.eye.up.set(0, 0, 1);
    this.#controls = new OrbitControls(this.eye, canvas);
    this.#controls.enableDamping = !reducedMotion.matches;
    reducedMotion.addEventListener(
      'change',
      () => (this.#controls.enableDamping = !reducedMotion.matches),
    );
    this.#controls.dampingFactor = 0.12;
    this.#controls.addEventListener('change', onChange);
    this.#controls.addEventListener('start', () => (this.#isMoved = true));
    canvas.addEventListener('keydown', (event) => this.#handleKey(event));
  }

  /** The distances between which fog sets in: the subject's near side and beyond its far side. */
  depthRange(): [number, number] {
    const distance = this.eye.position.distanceTo(this.#center);
    return [distance - 0.4 * this.#radius, distance + 2.2 * this.#radius];
  }

  /** Advances the damping; call it once per frame. */
  update(): void {
    this.#controls.update();
  }

  /** The bounding sphere of what is shown. */
  setSubject(center: Vector3, radius: number): void {
    this.#center = center;
    this.#radius = radius;
    this.#controls.minDistance = radius / 20;
    this.#controls.maxDistance = radius * 20;
    this.eye.near = radius / 100;
    this.eye.far = radius * 50;
  }

  /** Fits a subject that has grown into view, unless the user has moved the camera. */
  follow(center: Vector3, radius: number): void {
    if (radius < this.#radius * GROWTH) return;
    this.setSubject(center, radius);
    if (!this.#isMoved) this.fit();
  }

  /** Shows the whole subject, from a direction in degrees or from the current one. */
  fit(orbit?: readonly [number, number]): void {
    const half = MathUtils.degToRad(this.eye.fov / 2);
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.eye.aspect));
    const distance = (this.#radius / Math.sin(narrow)) * 0.84;
    const direction = this.eye.position.clone().sub(this.#controls.target);
    if (orbit) {
      const [azimuth, elevation] = orbit.map(MathUtils.degToRad) as [number, number];
      direction.set(
        Math.cos(elevation) * Math.sin(azimuth),
        -Math.cos(elevation) * Math.cos(azimuth),
        Math.sin(elevation),
      );
    }
    this.#isMoved = false;
    this.#controls.target.copy(this.#center);
    this.eye.position.copy(this.#center).addScaledVector(direction.normalize(), distance);
    this.eye.updateProjectionMatrix();
    this.#controls.update();
  }

  setAspect(aspect: number): void {
    this.eye.aspect = aspect;
    this.eye.updateProjectionMatrix();
  }

  #handleKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const turns: Record<string, [number, number, number]> = {
      ArrowLeft: [-1, 0, 1],
      ArrowRight: [1, 0, 1],
      ArrowUp: [0, -1, 1],
      ArrowDown: [0, 1, 1],
      '+': [0, 0, 1 / 1.1],
      '=': [0, 0, 1 / 1.1],
      '-': [0, 0, 1.1],
    };
    const turn = turns[event.key];
    if (!turn) return;
    event.preventDefault();
    this.#isMoved = true;
    this.#turn(...turn);
  }

  #turn(sideways: number, upwards: number, stretch: number): void {
    // Spherical has y up, the camera z.
    const offset = this.eye.position.clone().sub(this.#controls.target);
    const position = new Spherical().setFromCartesianCoords(offset.x, offset.z, -offset.y);
    position.theta += sideways * KEY_STEP;
    position.phi = MathUtils.clamp(position.phi + upwards * KEY_STEP, 0.01, Math.PI - 0.01);
    position.radius = MathUtils.clamp(
      position.radius * stretch,
      this.#controls.minDistance,
      this.#controls.maxDistance,
    );
    const turned = new Vector3().setFromSpherical(position);
    this.eye.position.copy(this.#controls.target).add(new Vector3(turned.x, -turned.z, turned.y));
    this.#controls.update();
  }
}
