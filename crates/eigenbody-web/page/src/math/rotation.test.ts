import { expect, test } from "vitest";
import { quaternion, rotationVector } from "./rotation";

test.each([[[0, 0, 0]], [[1, 0, 0]], [[0.3, -1.2, 2]], [[1e-9, 0, 0]], [[0, 3.1, 0]]])("there and back: %j", (vector) => {
  rotationVector(quaternion(vector)).forEach((c, k) => expect(c).toBeCloseTo(vector[k]!, 14));
});

test("q and −q are the same rotation", () => {
  const q = quaternion([0.3, -1.2, 2]);
  const other = rotationVector(q.map((c) => -c) as typeof q);
  rotationVector(q).forEach((c, k) => expect(other[k]).toBeCloseTo(c, 14));
});
