/** The robot by three.js. Links are one mesh of boxes; axes, centres and arrows one each. */

import {
  AmbientLight, BufferGeometry, DirectionalLight, DoubleSide, Float32BufferAttribute, GridHelper, Group, LineBasicMaterial,
  LineSegments, Material, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, PlaneGeometry, Quaternion, Raycaster, Scene, SphereGeometry, Vector2, Vector3,
  WebGLRenderer, type Object3D,
} from "three";
import type { Description, Triangles } from "../api/types";
import { along, arrowSize, axisLength, slideGeometry, turnGeometry } from "./arc";
import { Copies } from "./copies";
import { matrix, placed } from "./frames";
import type { Hit, Painter } from "./painter";
import { ARROWS, type Arrow, type Picture } from "./picture";
import { faceted, shapeGroup, tint } from "./shapes";

/** Smallest half extent of a box, over the robot's extent: so that it is seen, and its matrix can be inverted. */
const THINNEST = 1.5e-3;
/** Above so many bodies each is too small for its overlays to need smooth curves. */
const MANY = 60;

/** None if the browser has no WebGL. `mesh` gets the triangles of a mesh, `changed` is told that there is more to draw. */
export function glPainter(canvas: HTMLCanvasElement, mesh: (k: number) => Promise<Triangles>, changed: () => void): Painter | null {
  const wanted = { alpha: true, depth: true, stencil: false };
  const fast = canvas.getContext("webgl2", { ...wanted, antialias: true, failIfMajorPerformanceCaveat: true });
  // Without a graphics processor edges are smoothed only where nothing moves.
  const context = fast ?? canvas.getContext("webgl2", { ...wanted, antialias: false });
  return context && new GlPainter(canvas, context, fast !== null, mesh, changed);
}

class GlPainter implements Painter {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly sun = new DirectionalLight(0xffffff, 2.2);
  private readonly robot = new Group();
  private readonly caster = new Raycaster();
  private model: Description | null = null;
  private boxes: Copies | null = null;
  private readonly local: Matrix4[] = [];
  private shapes: Group[] = [];
  private still = new Group();
  private readonly meshes = new Map<number, Promise<BufferGeometry>>();
  private axes: Copies | null = null;
  private centres: Copies | null = null;
  private turns: Copies | null = null;
  private slides: Copies | null = null;
  private skeleton: LineSegments | null = null;
  private floor: GridHelper | null = null;
  private floorOf = "";
  private last: Picture | null = null;
  private size = "";

  constructor(
    readonly canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    private readonly fast: boolean,
    private readonly mesh: (k: number) => Promise<Triangles>,
    private readonly changed: () => void,
  ) {
    this.renderer = new WebGLRenderer({ canvas, context });
    this.scene.add(new AmbientLight(0xffffff, 1.3), this.sun, this.sun.target, this.robot);
  }

  load(model: Description): void {
    dispose(this.robot);
    this.model = model;
    const n = Math.max(1, model.bodies.length);
    const thinnest = THINNEST * (model.extent || 1);
    this.local.length = 0;
    for (const body of model.bodies) {
      const half = body.box?.half ?? [0, 0, 0];
      const size = new Vector3(...half.map((h) => 2 * Math.max(h, thinnest)) as [number, number, number]);
      const size4 = new Matrix4().makeScale(size.x, size.y, size.z);
      this.local.push(body.box ? matrix(body.box.pose).multiply(size4) : new Matrix4().setPosition(...body.centre).multiply(size4));
    }
    const many = model.bodies.length > MANY;
    this.boxes = this.copies(cornerGeometry(), new MeshLambertMaterial({ flatShading: true, side: DoubleSide }), n);
    const ribbon = new PlaneGeometry(1, 1).rotateX(Math.PI / 2);
    this.axes = this.copies(ribbon, new MeshBasicMaterial({ side: DoubleSide }), model.dofs.length);
    const over = new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9 });
    this.centres = this.copies(many ? new SphereGeometry(1, 8, 6) : new SphereGeometry(1, 14, 10), over, n);
    this.centres.renderOrder = 2;
    // Joints are inside of links: arrows are seen through them.
    const through = () => new MeshBasicMaterial({ depthTest: false, transparent: true });
    const most = Math.min(ARROWS, model.dofs.length);
    this.turns = this.copies(turnGeometry(many), through(), most);
    this.slides = this.copies(slideGeometry(many), through(), most);
    this.turns.renderOrder = this.slides.renderOrder = 3;
    const lines = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(new Float32Array(6 * n), 3));
    this.skeleton = new LineSegments(lines, new LineBasicMaterial());
    this.skeleton.frustumCulled = false;
    this.robot.add(this.skeleton);
    const bring = (k: number, part: Mesh) => void this.bring(k, part);
    this.shapes = model.bodies.map(({ shapes }, k) => shapeGroup(shapes, k, bring));
    this.still = shapeGroup(model.still, null, bring);
    this.robot.add(this.still, ...this.shapes.filter(({ children }) => children.length > 0));
  }

  resize(width: number, height: number, fine: boolean): void {
    const ratio = this.fast ? Math.min(2, devicePixelRatio) : fine ? 2 : 1;
    // Even the same size would make a new buffer.
    const size = `${width} ${height} ${ratio}`;
    if (size === this.size) return;
    this.size = size;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
  }

  paint(picture: Picture): void {
    const { model, boxes } = this;
    if (!model || !boxes) return;
    this.last = picture;
    const shaped = picture.shapes && model.bodies.some((body) => body.shapes.length > 0);
    this.still.visible = shaped;
    tint(this.still, picture.theme.pale);
    const at = new Matrix4();
    for (const [k, body] of model.bodies.entries()) {
      const place = picture.places[k];
      if (!place) continue;
      matrix(place, at);
      const group = this.shapes[k];
      if (group) {
        group.visible = shaped;
        group.matrix.copy(at);
        group.matrixWorldNeedsUpdate = true;
        tint(group, picture.colours[k] ?? 0);
      }
      // With visuals on, a body without any is its box.
      const boxed = !shaped || body.shapes.length === 0;
      boxes.put(k, boxed ? facing(at.multiply(this.local[k]!), picture.camera.position) : NOTHING, picture.colours[k] ?? 0);
    }
    boxes.show(model.bodies.length);
    this.paintAxes(picture);
    this.paintCentres(picture, model);
    this.paintSkeleton(picture, model);
    this.paintArrows(picture);
    this.paintFloor(picture);
    this.sun.position.copy(picture.camera.position).addScaledVector(picture.up, 0.6 * picture.camera.position.length() + picture.size);
    this.renderer.render(this.scene, picture.camera);
  }

  pick(x: number, y: number): Hit | null {
    if (!this.last || !this.boxes) return null;
    this.caster.setFromCamera(new Vector2(x, y), this.last.camera);
    const candidates: Object3D[] = [this.boxes, ...this.shapes.filter((group) => group.visible)];
    const [hit] = this.caster.intersectObjects(candidates, true);
    if (!hit) return null;
    const body = hit.object === this.boxes ? this.boxes.copyOf(hit.faceIndex ?? 0) : (hit.object.userData["body"] as number | undefined);
    return body === undefined ? null : { body, point: hit.point };
  }

  /** Shows a mesh once it is there; each is asked for once. */
  private async bring(k: number, part: Mesh): Promise<void> {
    const found = this.meshes.get(k) ?? this.mesh(k).then(faceted);
    this.meshes.set(k, found);
    try {
      part.geometry = await found;
      this.changed();
    } catch {
      this.meshes.delete(k);
    }
  }

  private paintAxes({ axes, camera, overlays, scale, theme }: Picture): void {
    const mesh = this.axes!;
    const shown = overlays.has("axes") ? axes.slice(0, mesh.most) : [];
    const length = axisLength(axes.length);
    const [x, z, at] = [new Vector3(), new Vector3(), new Matrix4()];
    shown.forEach(({ origin, direction, slides }, k) => {
      // A ribbon that turns its breadth to the eye.
      x.subVectors(camera.position, origin).cross(direction).setLength(Math.min(0.016, length / 8) * scale);
      at.makeBasis(x, direction, z.copy(direction).multiplyScalar(length * scale)).setPosition(origin);
      mesh.put(k, at, slides ? theme.green : theme.ink);
    });
    mesh.show(shown.length);
  }

  private paintCentres({ places, overlays, scale, theme }: Picture, model: Description): void {
    const mesh = this.centres!;
    const heaviest = Math.max(...model.bodies.map((body) => body.mass), Number.MIN_VALUE);
    const shown = overlays.has("centres") ? model.bodies.length : 0;
    for (let k = 0; k < shown; k++) {
      const [body, place] = [model.bodies[k]!, places[k]];
      const size = place && body.mass > 0 ? 0.075 * scale * Math.max(0.25, Math.cbrt(body.mass / heaviest)) : 0;
      mesh.put(k, place ? new Matrix4().makeScale(size, size, size).setPosition(placed(place, body.centre)) : NOTHING, theme.purple);
    }
    mesh.show(shown);
  }

  private paintSkeleton({ places, overlays, theme }: Picture, model: Description): void {
    const lines = this.skeleton!;
    lines.visible = overlays.has("skeleton");
    if (!lines.visible) return;
    const ends = lines.geometry.getAttribute("position");
    model.bodies.forEach(({ parent }, k) => {
      const [place, before] = [places[k], parent === null ? null : places[parent]];
      if (!place) return;
      // From the joint before; the first body's line begins and ends at its own.
      const [x, y, z] = before ?? place;
      ends.setXYZ(2 * k, x, y, z);
      ends.setXYZ(2 * k + 1, place[0], place[1], place[2]);
    });
    ends.needsUpdate = true;
    (lines.material as LineBasicMaterial).color.setHex(theme.soft);
  }

  private paintArrows({ arrows, axes, overlays, scale, arrowColour }: Picture): void {
    const shown = overlays.has("arrows") ? arrows : [];
    const largest = arrowSize(axes.length) * scale;
    const put = (mesh: Copies, list: Arrow[], length: number) => {
      list.forEach(({ origin, direction, rate }, k) => {
        const towards = rate < 0 ? direction.clone().negate() : direction;
        mesh.put(k, along(origin, towards, length * Math.sqrt(Math.abs(rate))), arrowColour);
      });
      mesh.show(list.length);
    };
    put(this.turns!, shown.filter(({ slides }) => !slides), largest);
    put(this.slides!, shown.filter(({ slides }) => slides), 1.2 * largest);
  }

  private paintFloor({ overlays, up, size, theme }: Picture): void {
    const key = `${size} ${up.toArray().join()} ${theme.faint}`;
    if (key !== this.floorOf) {
      if (this.floor) {
        this.scene.remove(this.floor);
        this.floor.dispose();
      }
      const cell = 10 ** Math.round(Math.log10(size / 3));
      const cells = 2 * Math.ceil((1.1 * size) / cell);
      this.floor = new GridHelper(cells * cell, cells, theme.faint, theme.faint);
      // What lies in the floor is seen on it.
      this.floor.renderOrder = -1;
      this.floor.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), up));
      const [first] = this.last?.places ?? [];
      // Grid lines stand at whole cells, the floor through the world's origin.
      if (first) this.floor.position.copy(flattened(new Vector3(first[0], first[1], first[2]), up, cell));
      this.scene.add(this.floor);
      this.floorOf = key;
    }
    if (this.floor) this.floor.visible = overlays.has("floor");
  }

  private copies(shape: BufferGeometry, material: Material, most: number): Copies {
    const mesh = new Copies(shape, material, most);
    this.robot.add(mesh);
    return mesh;
  }
}

const NOTHING = new Matrix4().makeScale(0, 0, 0);

/** The three faces of the unit box at its corner (½, ½, ½): more are not seen from outside. */
function cornerGeometry(): BufferGeometry {
  const corners = [7, 6, 4, 5, 1, 3, 2].flatMap((k) => [k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5]);
  const faces = [1, 2, 3, 4, 5, 6].flatMap((k) => [0, k, (k % 6) + 1]);
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(corners, 3)).setIndex(faces);
}

/** The place of a box, mirrored so that the corner with its faces is the one nearest to the eye. */
function facing(place: Matrix4, eye: Vector3): Matrix4 {
  const { elements: e } = place;
  for (const k of [0, 4, 8]) {
    const towards = e[k]! * (eye.x - e[12]) + e[k + 1]! * (eye.y - e[13]) + e[k + 2]! * (eye.z - e[14]);
    if (towards < 0) for (const i of [k, k + 1, k + 2]) e[i]! *= -1;
  }
  return place;
}

/** A point's shadow on the floor, at a whole cell. */
function flattened(point: Vector3, up: Vector3, cell: number): Vector3 {
  return point.addScaledVector(up, -point.dot(up)).divideScalar(cell).round().multiplyScalar(cell);
}

function dispose(group: Group): void {
  group.traverse((object) => {
    const mesh = object as Partial<Mesh>;
    mesh.geometry?.dispose();
    for (const material of [mesh.material ?? []].flat()) material.dispose();
  });
  group.clear();
}
