/** A camera that goes round a point, upright against gravity. */

import { Box3, PerspectiveCamera, Sphere, Vector3 } from "three";
import type { Description, Pose } from "../api/types";
import { FIRST, type EyeState } from "../state/state";
import { placed } from "./frames";

const FIELD = 35;
/** Steepest elevation (rad): straight down, "up" on the screen would be nowhere. */
const STEEPEST = 1.55;

export class Eye {
  readonly camera = new PerspectiveCamera(FIELD, 1, 0.01, 100);
  private readonly up = new Vector3(0, 0, 1);
  private readonly east = new Vector3(1, 0, 0);
  private readonly north = new Vector3(0, 1, 0);
  /** The sphere that a robot fills where it was looked at first. */
  private fit = new Sphere(new Vector3(), 1);
  private extent = 1;

  state: EyeState = FIRST.eye;

  /** Stands upright for this robot. */
  load(model: Description): void {
    const up = new Vector3(...model.gravity).negate();
    this.up.copy(up.lengthSq() > 0 ? up.normalize() : new Vector3(0, 0, 1));
    // Azimuth zero is before a robot that faces x; where up is y, as for the families, the first look is nearly square to their plane.
    this.east.copy(Math.abs(this.up.y) > 0.9 ? new Vector3(-0.4, 0, 1).normalize() : new Vector3(1, 0, 0));
    this.north.crossVectors(this.up, this.east).normalize();
    this.east.crossVectors(this.north, this.up);
    this.extent = model.extent > 0 ? model.extent : 1;
  }

  /** Takes in the whole robot. */
  frame(model: Description, places: readonly Pose[]): void {
    const box = new Box3();
    for (const [k, body] of model.bodies.entries()) {
      const place = places[k];
      if (!place) continue;
      box.expandByPoint(placed(place, [0, 0, 0]));
      for (let corner = 0; body.box && corner < 8; corner++) {
        const [x, y, z] = body.box.half;
        const inBody = placed(body.box.pose, [corner & 1 ? x : -x, corner & 2 ? y : -y, corner & 4 ? z : -z]);
        box.expandByPoint(placed(place, inBody.toArray()));
      }
    }
    if (box.isEmpty()) box.expandByPoint(new Vector3());
    box.getBoundingSphere(this.fit);
    if (!(this.fit.radius > 0)) this.fit.radius = this.extent;
  }

  get target(): Vector3 {
    return this.state.distance > 0 ? new Vector3(...this.state.target) : this.fit.center.clone();
  }

  get distance(): number {
    const narrow = Math.min(1, this.camera.aspect);
    return this.state.distance > 0 ? this.state.distance : (1.08 * this.fit.radius) / Math.sin((FIELD / 2) * (Math.PI / 180)) / narrow;
  }

  /** Puts the camera where the state says. */
  place(aspect: number): void {
    this.camera.aspect = aspect;
    const { azimuth, elevation } = this.state;
    const out = this.east.clone().multiplyScalar(Math.cos(elevation) * Math.cos(azimuth));
    out.addScaledVector(this.north, Math.cos(elevation) * Math.sin(azimuth)).addScaledVector(this.up, Math.sin(elevation));
    const [target, distance] = [this.target, this.distance];
    this.camera.position.copy(target).addScaledVector(out, distance);
    this.camera.up.copy(this.up);
    this.camera.lookAt(target);
    this.camera.near = distance / 300;
    this.camera.far = distance + target.length() + 6 * this.extent;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  /** The state with the fitted numbers written out. */
  private explicit(): EyeState {
    return { ...this.state, distance: this.distance, target: this.target.toArray() };
  }

  turned(right: number, up: number): EyeState {
    const elevation = Math.max(-STEEPEST, Math.min(STEEPEST, this.state.elevation + up));
    return { ...this.state, azimuth: wrapped(this.state.azimuth + right), elevation };
  }

  zoomed(factor: number): EyeState {
    const distance = Math.max(this.fit.radius / 200, Math.min(50 * this.fit.radius, this.distance * factor));
    return { ...this.explicit(), distance };
  }

  /** Moves the target by parts of the screen's height. */
  shifted(right: number, up: number): EyeState {
    const height = 2 * this.distance * Math.tan((FIELD / 2) * (Math.PI / 180));
    const [x, y] = [new Vector3(), new Vector3()];
    this.camera.matrixWorld.extractBasis(x, y, new Vector3());
    const target = this.target.addScaledVector(x, right * height).addScaledVector(y, up * height);
    return { ...this.explicit(), target: target.toArray() };
  }

  /** Upwards, as the floor has it. */
  get upward(): Vector3 {
    return this.up;
  }

  /** The robot's size (m). */
  get size(): number {
    return this.extent;
  }
}

function wrapped(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
