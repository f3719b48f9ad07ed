/** Who draws: WebGL where there is one, a plain canvas elsewhere. */

import type { Vector3 } from "three";
import type { Description } from "../api/types";
import type { Picture } from "./picture";

export interface Hit {
  body: number;
  point: Vector3;
}

export interface Painter {
  readonly canvas: HTMLCanvasElement;
  /** Forgets the robot before and prepares for this one. */
  load(model: Description): void;
  /** In CSS pixels; `fine` while nothing moves. */
  resize(width: number, height: number, fine: boolean): void;
  paint(picture: Picture): void;
  /** What is seen at a point of the canvas, −1 to 1, y up. */
  pick(x: number, y: number): Hit | null;
}
