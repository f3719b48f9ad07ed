/**
 * Many copies of one shape as one mesh, each placed by the processor.
 *
 * Without a graphics processor every instance of an `InstancedMesh` is a draw call of its own, which costs more than its triangles.
 */

import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Mesh, Sphere, Vector3, type Material, type Matrix4 } from "three";

export class Copies extends Mesh<BufferGeometry, Material> {
  /** Of one copy: its points, and how many numbers its index has. */
  private readonly shape: ArrayLike<number>;
  private readonly corners: number;
  private readonly points: BufferAttribute;
  private readonly tints: BufferAttribute;
  /** The colours that the copies have, `0xrrggbb`. */
  private readonly colours: Int32Array;

  /** `shape` is indexed, and lit facet by facet if the material is. */
  constructor(shape: BufferGeometry, material: Material, readonly most: number) {
    super(new BufferGeometry(), material);
    material.vertexColors = true;
    this.shape = shape.getAttribute("position").array;
    this.points = new BufferAttribute(new Float32Array(most * this.shape.length), 3).setUsage(DynamicDrawUsage);
    this.tints = new BufferAttribute(new Float32Array(most * this.shape.length), 3).setUsage(DynamicDrawUsage);
    this.colours = new Int32Array(most).fill(-1);
    const index = shape.getIndex()!.array;
    this.corners = index.length;
    const indices = new Uint32Array(most * index.length);
    for (let k = 0; k < most; k++) for (let i = 0; i < index.length; i++) indices[k * index.length + i] = index[i]! + (k * this.shape.length) / 3;
    this.geometry.setAttribute("position", this.points).setAttribute("color", this.tints).setIndex(new BufferAttribute(indices, 1));
    // Copies may be anywhere: nobody has to measure where they are.
    this.geometry.boundingSphere = new Sphere(new Vector3(), Infinity);
    this.frustumCulled = false;
    shape.dispose();
  }

  /** Puts the k-th copy. */
  put(k: number, { elements: e }: Matrix4, colour: number): void {
    const { shape } = this;
    const points = this.points.array;
    for (let i = 0, at = k * shape.length; i < shape.length; i += 3, at += 3) {
      const [x, y, z] = [shape[i]!, shape[i + 1]!, shape[i + 2]!];
      points[at] = e[0] * x + e[4] * y + e[8] * z + e[12];
      points[at + 1] = e[1] * x + e[5] * y + e[9] * z + e[13];
      points[at + 2] = e[2] * x + e[6] * y + e[10] * z + e[14];
    }
    if (this.colours[k] === colour) return;
    this.colours[k] = colour;
    const { r, g, b } = TINT.setHex(colour);
    for (let at = k * shape.length; at < (k + 1) * shape.length; at += 3) this.tints.array.set([r, g, b], at);
    this.tints.needsUpdate = true;
  }

  /** Shows the first copies, as they have been put. */
  show(count: number): void {
    this.visible = count > 0;
    this.geometry.setDrawRange(0, count * this.corners);
    this.points.clearUpdateRanges();
    this.points.addUpdateRange(0, count * this.shape.length);
    this.points.needsUpdate = count > 0;
  }

  /** The copy that a face belongs to. */
  copyOf(face: number): number {
    return Math.floor((3 * face) / this.corners);
  }
}

const TINT = new Color();
