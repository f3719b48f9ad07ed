/** The coordinates of a joint as numbers that a slider can have: a quaternion becomes a rotation vector. */

import type { Joint } from "../api/types";
import { quaternion, rotationVector, type Quaternion } from "../math/rotation";

export interface Handle {
  joint: number;
  label: string;
  unit: string;
  range: [number, number];
  get(q: readonly number[]): number;
  set(q: readonly number[], x: number): number[];
}

const LETTERS = ["x", "y", "z"] as const;

/** A slider for every number that the joint can be moved by. */
export function handles(joint: Joint, index: number): Handle[] {
  const single = (offset: number, label: string, unit: string, range: [number, number]): Handle => ({
    joint: index,
    label,
    unit,
    range,
    get: (q) => q[joint.q + offset] ?? 0,
    set: (q, x) => q.with(joint.q + offset, x),
  });
  const turns = (offset: number): Handle[] =>
    LETTERS.map((letter, k) => ({
      joint: index,
      label: `${joint.name} turn ${letter}`,
      unit: "rad",
      range: [-Math.PI, Math.PI],
      get: (q) => rotationVector(turnOf(q, joint.q + offset))[k]!,
      set: (q, x) => {
        const vector = rotationVector(turnOf(q, joint.q + offset));
        vector[k] = x;
        return q.toSpliced(joint.q + offset, 4, ...quaternion(vector));
      },
    }));
  const round: [number, number] = [-Math.PI, Math.PI];
  const reach: [number, number] = joint.unit === "m" ? joint.range : [-1, 1];
  switch (joint.kind) {
    case "spherical":
      return turns(0);
    case "floating":
      return [...LETTERS.map((letter, k) => single(k, `${joint.name} ${letter}`, "m", [-1, 1])), ...turns(3)];
    case "planar":
      return [single(0, `${joint.name} x`, "m", reach), single(1, `${joint.name} y`, "m", reach), single(2, `${joint.name} turn`, "rad", round)];
    case "cylindrical":
      return [single(0, `${joint.name} turn`, "rad", round), single(1, `${joint.name} slide`, "m", reach)];
    case "universal":
      return [single(0, `${joint.name} first`, "rad", round), single(1, `${joint.name} second`, "rad", round)];
    default:
      return joint.nq === 1 ? [single(0, joint.name, joint.unit, joint.range)] : [];
  }
}

/** A ball joint turned by an angle about one of its own axes. */
export function turnedTo(q: readonly number[], joint: Joint, axis: number, angle: number): number[] {
  const [w, x, y, z] = turnOf(q, joint.q);
  const step = [0, 0, 0].with(axis, angle);
  const [a, b, c, d] = quaternion(step);
  const product = [w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c, w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a];
  const norm = Math.hypot(...product);
  return q.toSpliced(joint.q, 4, ...product.map((part) => part / norm));
}

function turnOf(q: readonly number[], at: number): Quaternion {
  return [q[at] ?? 1, q[at + 1] ?? 0, q[at + 2] ?? 0, q[at + 3] ?? 0];
}
