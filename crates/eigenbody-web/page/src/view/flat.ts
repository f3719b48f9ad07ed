/** The robot on a plain canvas, for browsers without WebGL: boxes as faces from far to near, and the overlays as lines. */

import { Matrix4, Vector3 } from "three";
import type { Description } from "../api/types";
import { cssColour } from "../theme";
import { arcPoints, arrowSize, axisLength } from "./arc";
import { matrix, placed } from "./frames";
import type { Hit, Painter } from "./painter";
import type { Picture } from "./picture";

const CORNERS = Array.from({ length: 8 }, (_, k) => new Vector3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
/** Faces by their corners, anticlockwise seen from outside. */
const FACES = [[1, 3, 7, 5], [0, 4, 6, 2], [2, 6, 7, 3], [0, 1, 5, 4], [4, 5, 7, 6], [0, 2, 3, 1]] as const;
const THINNEST = 1.5e-3;

interface Face {
  body: number;
  depth: number;
  light: number;
  points: Vector3[];
}

export function flatPainter(canvas: HTMLCanvasElement): Painter {
  return new FlatPainter(canvas);
}

class FlatPainter implements Painter {
  private model: Description | null = null;
  private local: Matrix4[] = [];
  private faces: Face[] = [];
  private last: Picture | null = null;
  private readonly pen: CanvasRenderingContext2D;

  constructor(readonly canvas: HTMLCanvasElement) {
    const pen = canvas.getContext("2d");
    if (!pen) throw new Error("this browser cannot draw on a canvas");
    this.pen = pen;
  }

  load(model: Description): void {
    this.model = model;
    const thinnest = THINNEST * (model.extent || 1);
    this.local = model.bodies.map(({ box, centre }) => {
      const [x, y, z] = (box?.half ?? [0, 0, 0]).map((half) => Math.max(half, thinnest)) as [number, number, number];
      return (box ? matrix(box.pose) : new Matrix4().setPosition(...centre)).multiply(new Matrix4().makeScale(x, y, z));
    });
  }

  resize(width: number, height: number): void {
    const ratio = Math.min(2, devicePixelRatio);
    const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== w || this.canvas.height !== h) [this.canvas.width, this.canvas.height] = [w, h];
  }

  paint(picture: Picture): void {
    const { pen, canvas, model } = this;
    this.last = picture;
    pen.clearRect(0, 0, canvas.width, canvas.height);
    if (!model) return;
    pen.lineJoin = "round";
    this.faces = model.bodies.flatMap((_, k) => this.bodyFaces(k, picture)).sort((a, b) => b.depth - a.depth);
    for (const face of this.faces) {
      pen.fillStyle = shaded(picture.colours[face.body] ?? 0, face.light);
      this.line(face.points, pen.fillStyle, 1, true);
      pen.fill();
    }
    const { theme, overlays, scale } = picture;
    if (overlays.has("skeleton")) {
      model.bodies.forEach(({ parent }, k) => {
        const [place, before] = [picture.places[k], parent === null ? null : picture.places[parent]];
        if (place && before) this.segment([new Vector3(before[0], before[1], before[2]), new Vector3(place[0], place[1], place[2])], theme.soft, 1);
      });
    }
    if (overlays.has("axes")) {
      for (const { origin, direction, slides } of picture.axes) {
        const ends = [-0.5, 0.5].map((part) => origin.clone().addScaledVector(direction, part * axisLength(picture.axes.length) * scale));
        this.segment(ends, slides ? theme.green : theme.ink, 2);
      }
    }
    if (overlays.has("centres")) {
      model.bodies.forEach(({ centre, mass }, k) => {
        const place = picture.places[k];
        const at = place && mass > 0 ? this.project(placed(place, centre)) : null;
        if (!at) return;
        pen.beginPath();
        pen.arc(at.x, at.y, 5, 0, 2 * Math.PI);
        pen.fillStyle = cssColour(theme.purple);
        pen.fill();
      });
    }
    if (overlays.has("arrows")) {
      for (const { origin, direction, slides, rate } of picture.arrows) {
        const towards = rate < 0 ? direction.clone().negate() : direction;
        const size = scale * arrowSize(picture.axes.length) * Math.sqrt(Math.abs(rate));
        const points = slides ? [origin, origin.clone().addScaledVector(towards, 2.4 * size)] : arcPoints(origin, towards, size);
        this.segment(points, picture.arrowColour, 2.5);
        this.head(points, picture.arrowColour);
      }
    }
  }

  pick(x: number, y: number): Hit | null {
    const { last, model } = this;
    if (!last || !model) return null;
    const [px, py] = [((x + 1) / 2) * this.canvas.width, ((1 - y) / 2) * this.canvas.height];
    const path = (face: Face) => {
      const outline = new Path2D();
      face.points.forEach((p, k) => (k === 0 ? outline.moveTo(p.x, p.y) : outline.lineTo(p.x, p.y)));
      outline.closePath();
      return outline;
    };
    const face = this.faces.findLast((one) => this.pen.isPointInPath(path(one), px, py));
    const place = face && last.places[face.body];
    if (!face || !place) return null;
    // The point of the ray nearest to the body's centre of mass.
    const ray = new Vector3(x, y, 0.5).unproject(last.camera).sub(last.camera.position).normalize();
    const centre = placed(place, model.bodies[face.body]!.centre).sub(last.camera.position);
    return { body: face.body, point: last.camera.position.clone().addScaledVector(ray, centre.dot(ray)) };
  }

  private bodyFaces(k: number, { places, camera }: Picture): Face[] {
    const place = places[k];
    const local = this.local[k];
    if (!place || !local) return [];
    const world = matrix(place).multiply(local);
    const corners = CORNERS.map((corner) => corner.clone().applyMatrix4(world));
    const screen = corners.map((corner) => this.project(corner));
    return FACES.flatMap((face) => {
      const [a, b, , d] = face.map((c) => corners[c]!) as [Vector3, Vector3, Vector3, Vector3];
      const normal = b.clone().sub(a).cross(d.clone().sub(a)).normalize();
      const middle = face.reduce((sum, c) => sum.addScaledVector(corners[c]!, 0.25), new Vector3());
      const towards = camera.position.clone().sub(middle);
      const light = normal.dot(towards.clone().normalize());
      const points = face.flatMap((c) => screen[c] ?? []);
      return light > 0 && points.length === 4 ? [{ body: k, depth: towards.length(), light: 0.55 + 0.45 * light, points }] : [];
    });
  }

  /** On the canvas (px); none behind the camera. */
  private project(point: Vector3): Vector3 | null {
    const camera = this.last!.camera;
    if (point.clone().applyMatrix4(camera.matrixWorldInverse).z > -camera.near) return null;
    const at = point.clone().project(camera);
    return new Vector3(((at.x + 1) / 2) * this.canvas.width, ((1 - at.y) / 2) * this.canvas.height, 0);
  }

  private segment(points: Vector3[], colour: number, width: number): void {
    const seen = points.map((point) => this.project(point));
    if (seen.every((point) => point !== null)) this.line(seen as Vector3[], cssColour(colour), width, false);
  }

  private line(points: Vector3[], colour: string, width: number, closed: boolean): void {
    const { pen } = this;
    pen.beginPath();
    points.forEach((p, k) => (k === 0 ? pen.moveTo(p.x, p.y) : pen.lineTo(p.x, p.y)));
    if (closed) pen.closePath();
    pen.strokeStyle = colour;
    pen.lineWidth = width * Math.min(2, devicePixelRatio);
    pen.stroke();
  }

  private head(points: Vector3[], colour: number): void {
    const [before, tip] = points.slice(-2).map((point) => this.project(point));
    if (!before || !tip) return;
    const angle = Math.atan2(tip.y - before.y, tip.x - before.x);
    const { pen } = this;
    pen.beginPath();
    pen.moveTo(tip.x + 6 * Math.cos(angle), tip.y + 6 * Math.sin(angle));
    for (const side of [2.4, -2.4]) pen.lineTo(tip.x + 7 * Math.cos(angle + side), tip.y + 7 * Math.sin(angle + side));
    pen.closePath();
    pen.fillStyle = cssColour(colour);
    pen.fill();
  }
}

function shaded(colour: number, light: number): string {
  const channel = (shift: number) => Math.round(((colour >> shift) & 255) * light);
  return `rgb(${channel(16)} ${channel(8)} ${channel(0)})`;
}
