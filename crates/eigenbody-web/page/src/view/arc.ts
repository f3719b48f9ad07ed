/** How joints are drawn: axes, an arc with a head for a turn, an arrow for a slide. */

import { ConeGeometry, CylinderGeometry, Matrix4, Quaternion, TorusGeometry, Vector3, type BufferGeometry } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";

/** Angle that the arc goes round (rad). */
const SWEEP = 1.4 * Math.PI;

/** A right-handed turn about z, radius 1; `plain` where it is one of many. */
export function turnGeometry(plain: boolean): BufferGeometry {
  const arc = plain ? new TorusGeometry(1, 0.07, 3, 12, SWEEP) : new TorusGeometry(1, 0.055, 4, 24, SWEEP);
  const head = new ConeGeometry(0.17, 0.42, plain ? 4 : 8);
  head.translate(0, 0.16, 0).applyMatrix4(new Matrix4().makeRotationZ(SWEEP)).translate(Math.cos(SWEEP), Math.sin(SWEEP), 0);
  return mergeGeometries([arc, head]);
}

/** A slide along z, length 2. */
export function slideGeometry(plain: boolean): BufferGeometry {
  const sides = plain ? 4 : 12;
  const shaft = new CylinderGeometry(0.055, 0.055, 1.6, sides).rotateX(Math.PI / 2).translate(0, 0, 0.8);
  const head = new ConeGeometry(0.17, 0.42, sides).rotateX(Math.PI / 2).translate(0, 0, 1.8);
  return mergeGeometries([shaft, head]);
}

/** The matrix that takes z to `direction`, the origin to `origin`, and lengths by `size`. */
export function along(origin: Vector3, direction: Vector3, size: number | Vector3, out = new Matrix4()): Matrix4 {
  const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), direction);
  return out.compose(origin, turn, typeof size === "number" ? new Vector3(size, size, size) : size);
}

/** Points of the arc in the world, for a painter that has lines only. */
export function arcPoints(origin: Vector3, direction: Vector3, radius: number, steps = 24): Vector3[] {
  const place = along(origin, direction, radius);
  return Array.from({ length: steps + 1 }, (_, k) => {
    const angle = (SWEEP * k) / steps;
    return new Vector3(Math.cos(angle), Math.sin(angle), 0).applyMatrix4(place);
  });
}

/** Axes get shorter where there are many; over the size of the robot. */
export function axisLength(count: number): number {
  return Math.min(0.42, Math.max(0.06, 1.1 / Math.sqrt(count)));
}

/** So do the arrows of turns; their radius. */
export function arrowSize(count: number): number {
  return 0.17 * Math.min(1, Math.max(0.3, 6 / Math.sqrt(count)));
}
