import { MathUtils, PerspectiveCamera, Spherical, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

const KEY_STEP = MathUtils.degToRad(6);
const GROWTH = 1.05;  // less is not worth a jump
const isCalm = matchMedia('(prefers-reduced-motion: reduce)');

/** One camera for both halves; the world's z points up, as in scanners. */
export class Camera {
  readonly eye = new PerspectiveCamera(26, 1, 0.1, 1e5);
  readonly #controls: OrbitControls;
  #center = new Vector3();
  #radius = 1;
  /** Has somebody turned it since it was fitted? */
  #isTurned = false;

  constructor(canvas: HTMLElement, onChange: () => void) {
    this.eye.up.set(0, 0, 1);
    this.#controls = new OrbitControls(this.eye, canvas);
    this.#controls.enableDamping = !isCalm.matches;
    isCalm.addEventListener('change', () => (this.#controls.enableDamping = !isCalm.matches));
    this.#controls.dampingFactor = 0.12;
    this.#controls.addEventListener('change', onChange);
    this.#controls.addEventListener('start', () => (this.#isTurned = true));
    canvas.addEventListener('keydown', (event) => this.#obeyKey(event));
  }

  /** Where the subject begins, and somewhat behind its end. */
  depthRange(): [number, number] {
    const distance = this.eye.position.distanceTo(this.#center);
    return [distance - 0.4 * this.#radius, distance + 2.2 * this.#radius];
  }

  /** Moves on towards rest; to be called once a picture. */
  update(): void {
    this.#controls.update();
  }

  /** What there is to be seen. */
  setSubject(center: Vector3, radius: number): void {
    this.#center = center;
    this.#radius = radius;
    this.#controls.minDistance = radius / 20;
    this.#controls.maxDistance = radius * 20;
    this.eye.near = radius / 100;
    this.eye.far = radius * 50;
  }

  /** Takes a subject that has grown into view, but leaves the camera to whoever has turned it. */
  follow(center: Vector3, radius: number): void {
    if (radius < this.#radius * GROWTH) return;
    this.setSubject(center, radius);
    if (!this.#isTurned) this.fit();
  }

  /** The whole subject from a direction in degrees, or from where the camera is. */
  fit(orbit?: readonly [number, number]): void {
    const half = MathUtils.degToRad(this.eye.fov / 2);
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.eye.aspect));
    const distance = (this.#radius / Math.sin(narrow)) * 0.84;
    const direction = this.eye.position.clone().sub(this.#controls.target);
    if (orbit) {
      const [azimuth, elevation] = orbit.map(MathUtils.degToRad) as [number, number];
      direction.set(Math.cos(elevation) * Math.sin(azimuth), -Math.cos(elevation) * Math.cos(azimuth), Math.sin(elevation));
    }
    this.#isTurned = false;
    this.#controls.target.copy(this.#center);
    this.eye.position.copy(this.#center).addScaledVector(direction.normalize(), distance);
    this.eye.updateProjectionMatrix();
    this.#controls.update();
  }

  setAspect(aspect: number): void {
    this.eye.aspect = aspect;
    this.eye.updateProjectionMatrix();
  }

  #obeyKey(event: KeyboardEvent): void {
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
    this.#isTurned = true;
    this.#turn(...turn);
  }

  #turn(sideways: number, upwards: number, stretch: number): void {
    // Spherical counts from the y axis, the camera from z.
    const offset = this.eye.position.clone().sub(this.#controls.target);
    const place = new Spherical().setFromCartesianCoords(offset.x, offset.z, -offset.y);
    place.theta += sideways * KEY_STEP;
    place.phi = MathUtils.clamp(place.phi + upwards * KEY_STEP, 0.01, Math.PI - 0.01);
    place.radius = MathUtils.clamp(place.radius * stretch, this.#controls.minDistance, this.#controls.maxDistance);
    const turned = new Vector3().setFromSpherical(place);
    this.eye.position.copy(this.#controls.target).add(new Vector3(turned.x, -turned.z, turned.y));
    this.#controls.update();
  }
}
