import { PerspectiveCamera, Vector3 } from "three";
import { expect, test } from "vitest";
import { onScreen, stepFor } from "./drag";

function camera(): PerspectiveCamera {
  const eye = new PerspectiveCamera(35, 1.5, 0.1, 100);
  eye.position.set(0, 0, 10);
  eye.lookAt(0, 0, 0);
  eye.updateMatrixWorld();
  return eye;
}

test("a grabbed point follows the pointer", () => {
  const axis = { origin: new Vector3(), direction: new Vector3(0, 0, 1), slides: false };
  const eye = camera();
  const point = new Vector3(1, 0, 0);
  const angle = 1e-3;
  const there = new Vector3(Math.cos(angle), Math.sin(angle), 0).project(eye);
  const here = point.clone().project(eye);
  const step = stepFor(onScreen(axis, point, eye), there.x - here.x, there.y - here.y, 0);
  // The point moves along an arc, the step is along its tangent.
  expect(Math.abs(step - angle)).toBeLessThan(angle ** 2);
});

test("a slide too", () => {
  const axis = { origin: new Vector3(), direction: new Vector3(0, 1, 0), slides: true };
  const eye = camera();
  const [here, there] = [new Vector3(1, 0, 0).project(eye), new Vector3(1, 0.2, 0).project(eye)];
  expect(stepFor(onScreen(axis, new Vector3(1, 0, 0), eye), 0, there.y - here.y, 0)).toBeCloseTo(0.2, 6);
});

test("a point on the axis asks for no wild turn", () => {
  const axis = { origin: new Vector3(), direction: new Vector3(0, 0, 1), slides: false };
  const rate = onScreen(axis, new Vector3(0, 0, 1), camera());
  expect(Math.abs(stepFor(rate, 0.1, 0.1, 0.05))).toBeLessThan(1e-3);
});
