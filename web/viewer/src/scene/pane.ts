import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  type IUniform,
} from 'three';
import { surfaceMaterial } from './material.ts';
import type { Wireframes } from './wireframes.ts';

export interface Shape {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly indices: Uint32Array;
}

/** One half of the stage: a surface and, as an option, its edges. */
export class Pane {
  readonly group = new Group();
  readonly #geometry = new BufferGeometry();
  readonly #edges = new LineSegments(
    new BufferGeometry(),
    new LineBasicMaterial({ color: '#0b0d10', transparent: true, opacity: 0.25 }),
  );
  readonly #wireframes: Wireframes;
  #shape: Shape | undefined;
  #isWireframe = false;

  constructor(color: string, scale: IUniform<number>, wireframes: Wireframes) {
    this.#wireframes = wireframes;
    const material = surfaceMaterial(new Color(color), scale);
    material.polygonOffset = true; // draws the surface behind its edges
    material.polygonOffsetFactor = material.polygonOffsetUnits = 1;
    const mesh = new Mesh(this.#geometry, material);
    // Culling would have to compute bounds, and the surface fills the view anyway.
    mesh.frustumCulled = this.#edges.frustumCulled = false;
    this.#edges.visible = false;
    this.group.add(mesh, this.#edges);
  }

  get shape(): Shape | undefined {
    return this.#shape;
  }

  show(shape: Shape | undefined): void {
    this.#shape = shape;
    this.#geometry.dispose(); // frees the buffers of the previous surface
    this.group.visible = shape !== undefined;
    if (!shape) return;
    this.#geometry.setAttribute('position', new BufferAttribute(shape.positions, 3));
    this.#geometry.setAttribute('normal', new BufferAttribute(shape.normals, 3));
    this.#geometry.setIndex(new BufferAttribute(shape.indices, 1));
    this.#edges.visible = false;
  }

  setWireframe(on: boolean): void {
    this.#isWireframe = on;
    if (!on) this.#edges.visible = false;
  }

  /** Resolves to true if new edges are visible. */
  async drawEdges(): Promise<boolean> {
    const shape = this.#shape;
    if (!this.#isWireframe || !shape || this.#edges.visible) return false;
    const edges = await this.#wireframes.edgesOf(shape.indices);
    if (shape !== this.#shape || !this.#isWireframe) return false;
    this.#edges.geometry.dispose();
    this.#edges.geometry.setAttribute('position', this.#geometry.getAttribute('position'));
    this.#edges.geometry.setIndex(new BufferAttribute(edges, 1));
    this.#edges.visible = true;
    return true;
  }
}
