import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  type IUniform,
  type MeshStandardMaterial,
} from 'three';
import { coloured } from './chunk-colors.ts';
import { surfaceMaterial } from './material.ts';
import type { Wireframes } from './wireframes.ts';

export interface Shape {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly indices: Uint32Array;
  /** The same in pieces, in the order of the stream, if it is in chunks. */
  readonly chunks?: readonly Shape[];
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
  readonly #material: MeshStandardMaterial;
  readonly #color: Color;
  #shape: Shape | undefined;
  #drawn: Shape | undefined; // the shape, or its pieces
  #isWireframe = false;
  #isColouring = false;

  constructor(color: string, scale: IUniform<number>, wireframes: Wireframes) {
    this.#wireframes = wireframes;
    this.#color = new Color(color);
    this.#material = surfaceMaterial(this.#color, scale);
    this.#material.polygonOffset = true; // draws the surface behind its edges
    this.#material.polygonOffsetFactor = this.#material.polygonOffsetUnits = 1;
    const mesh = new Mesh(this.#geometry, this.#material);
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
    const pieces = this.#isColouring && shape.chunks ? coloured(shape.chunks) : undefined;
    const drawn = (this.#drawn = pieces ?? shape);
    this.#geometry.setAttribute('position', new BufferAttribute(drawn.positions, 3));
    this.#geometry.setAttribute('normal', new BufferAttribute(drawn.normals, 3));
    if (pieces) this.#geometry.setAttribute('color', new BufferAttribute(pieces.colors, 3));
    else this.#geometry.deleteAttribute('color');
    this.#geometry.setIndex(new BufferAttribute(drawn.indices, 1));
    this.#paint(pieces !== undefined);
    this.#edges.visible = false;
  }

  /** Gives each piece of the shape a colour. */
  setColouring(on: boolean): void {
    this.#isColouring = on;
    this.show(this.#shape);
  }

  setWireframe(on: boolean): void {
    this.#isWireframe = on;
    if (!on) this.#edges.visible = false;
  }

  /** Resolves to true if new edges are visible. */
  async drawEdges(): Promise<boolean> {
    const drawn = this.#drawn;
    if (!this.#isWireframe || !drawn || this.#edges.visible) return false;
    const edges = await this.#wireframes.edgesOf(drawn.indices);
    if (drawn !== this.#drawn || !this.#isWireframe) return false;
    this.#edges.geometry.dispose();
    this.#edges.geometry.setAttribute('position', this.#geometry.getAttribute('position'));
    this.#edges.geometry.setIndex(new BufferAttribute(edges, 1));
    this.#edges.visible = true;
    return true;
  }

  #paint(byVertex: boolean): void {
    if (this.#material.vertexColors === byVertex) return;
    this.#material.vertexColors = byVertex;
    this.#material.color = byVertex ? new Color('white') : this.#color;
    this.#material.needsUpdate = true;
  }
}
