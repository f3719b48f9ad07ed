/** Poses as three.js has them. */

import { Matrix4, Quaternion, Vector3 } from "three";
import type { Pose, Vec3 } from "../api/types";

const ONE = new Vector3(1, 1, 1);

export function matrix([x, y, z, qw, qx, qy, qz]: Pose, out = new Matrix4()): Matrix4 {
  return out.compose(new Vector3(x, y, z), new Quaternion(qx, qy, qz, qw), ONE);
}

/** A point of a frame in the world. */
export function placed([x, y, z, qw, qx, qy, qz]: Pose, point: Readonly<Vec3>): Vector3 {
  return new Vector3(...point).applyQuaternion(new Quaternion(qx, qy, qz, qw)).add(new Vector3(x, y, z));
}

/** A direction of a frame in the world. */
export function turned([, , , qw, qx, qy, qz]: Pose, direction: Vector3): Vector3 {
  return direction.clone().applyQuaternion(new Quaternion(qx, qy, qz, qw));
}

/** A point of the world in a frame. */
export function within([x, y, z, qw, qx, qy, qz]: Pose, point: Vector3): Vector3 {
  return point.clone().sub(new Vector3(x, y, z)).applyQuaternion(new Quaternion(-qx, -qy, -qz, qw));
}

/** A direction of the world in a frame. */
export function unturned([, , , qw, qx, qy, qz]: Pose, direction: Vector3): Vector3 {
  return direction.clone().applyQuaternion(new Quaternion(-qx, -qy, -qz, qw));
}

/** Part of the way from one pose to another: positions along a line, rotations along the shortest arc. */
export function between(a: Pose, b: Pose, part: number): Pose {
  const mix = (k: 0 | 1 | 2) => a[k] + part * (b[k] - a[k]);
  const rotation = new Quaternion(a[4], a[5], a[6], a[3]).slerp(new Quaternion(b[4], b[5], b[6], b[3]), part);
  return [mix(0), mix(1), mix(2), rotation.w, rotation.x, rotation.y, rotation.z];
}
