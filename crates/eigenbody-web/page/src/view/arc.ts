/** How joints are drawn: axes, an arc with a head for a turn, an arrow for a slide. */

import { BufferGeometry, ConeGeometry, CylinderGeometry, Float32BufferAttribute, Matrix4, Quaternion, TorusGeometry, Vector3 } from "three";

/** Angle that the arc goes round (rad). */
const SWEEP = 1.4 * Math.PI;

/** A right-handed turn about z, radius 1. */
export function turnGeometry(): BufferGeometry {
  const arc = new TorusGeometry(1, 0.055, 4, 24, SWEEP);
  const head = new ConeGeometry(0.17, 0.42, 8);
  head.translate(0, 0.16, 0).applyMatrix4(new Matrix4().makeRotationZ(SWEEP)).translate(Math.cos(SWEEP), Math.sin(SWEEP), 0);
  return merged([arc, head]);
}

/** A slide along z, length 2. */
export function slideGeometry(): BufferGeometry {
  const shaft = new CylinderGeometry(0.055, 0.055, 1.6, 8).rotateX(Math.PI / 2).translate(0, 0, 0.8);
  const head = new ConeGeometry(0.17, 0.42, 12).rotateX(Math.PI / 2).translate(0, 0, 1.8);
  return merged([shaft, head]);
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

function merged(parts: BufferGeometry[]): BufferGeometry {
  const [positions, normals]: [number[], number[]] = [[], []];
  for (const part of parts) {
    const flat = part.index ? part.toNonIndexed() : part;
    positions.push(...flat.getAttribute("position").array);
    normals.push(...flat.getAttribute("normal").array);
    part.dispose();
  }
  const whole = new BufferGeometry();
  whole.setAttribute("position", new Float32BufferAttribute(positions, 3));
  return whole.setAttribute("normal", new Float32BufferAttribute(normals, 3));
}

/** Axes get shorter where there are many; over the size of the robot. */
export function axisLength(count: number): number {
  return Math.min(0.42, Math.max(0.12, 1.1 / Math.sqrt(count)));
}
