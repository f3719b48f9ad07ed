/** Joints dragged in the view: the joint of the grabbed link turns so that the grabbed point follows the pointer. */

import { Vector3, type Camera } from "three";
import type { Description, Joint } from "../api/types";
import type { Axis } from "./picture";

/** Where a unit step of a DoF takes a point, on the screen (−1 to 1 a radian or metre). */
export function onScreen(axis: Axis, point: Vector3, camera: Camera): { x: number; y: number } {
  const velocity = axis.slides ? axis.direction.clone() : axis.direction.clone().cross(point.clone().sub(axis.origin));
  const step = 1e-4;
  const [here, there] = [point.clone().project(camera), point.clone().addScaledVector(velocity, step).project(camera)];
  return { x: (there.x - here.x) / step, y: (there.y - here.y) / step };
}

/** How far the DoF must go for the point to go by (dx, dy), least squares; `reach` is the length below which it is held back. */
export function stepFor(rate: { x: number; y: number }, dx: number, dy: number, reach: number): number {
  const square = rate.x ** 2 + rate.y ** 2;
  return (rate.x * dx + rate.y * dy) / (square + reach ** 2);
}

/** The joint that holds a link: its own, or the nearest before it that is free to move. */
export function holder(model: Description, body: number): number | null {
  for (let k: number | null = body; k !== null; k = model.bodies[k]?.parent ?? null) {
    const dof: number | undefined = model.bodies[k]?.dofs.at(-1);
    const joint = dof === undefined ? undefined : model.dofs[dof]?.joint;
    if (joint !== undefined && !model.joints[joint]?.follows && model.joints[joint]?.kind !== "floating") return joint;
  }
  return null;
}

/** A coordinate within the range of its slider. */
export function within(joint: Joint, x: number): number {
  const [low, high] = joint.limits ?? [-Infinity, Infinity];
  return Math.min(high, Math.max(low, x));
}
