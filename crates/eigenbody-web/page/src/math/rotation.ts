/** Unit quaternions w, x, y, z and rotation vectors. */

export type Quaternion = [number, number, number, number];

/** The rotation vector of a unit quaternion: axis times angle, angle at most π. */
export function rotationVector([w, x, y, z]: Quaternion): [number, number, number] {
  const sine = Math.hypot(x, y, z);
  if (sine === 0) return [0, 0, 0];
  // The same rotation with w ≥ 0 has the angle of at most π.
  const angle = w < 0 ? -2 * Math.atan2(sine, -w) : 2 * Math.atan2(sine, w);
  return [x, y, z].map((c) => (c / sine) * angle) as [number, number, number];
}

/** The unit quaternion of a rotation vector. */
export function quaternion(vector: readonly number[]): Quaternion {
  const [x = 0, y = 0, z = 0] = vector;
  const angle = Math.hypot(x, y, z);
  const scale = angle === 0 ? 0.5 : Math.sin(angle / 2) / angle;
  return [Math.cos(angle / 2), x * scale, y * scale, z * scale];
}
