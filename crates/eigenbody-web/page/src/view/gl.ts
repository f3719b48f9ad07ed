/** The robot by three.js. Links are one instanced mesh of boxes; axes, centres and arrows one each. */

import {
  AmbientLight, BoxGeometry, BufferGeometry, Color, CylinderGeometry, DirectionalLight, DynamicDrawUsage, Float32BufferAttribute, GridHelper, Group,
  InstancedMesh, LineBasicMaterial, LineSegments, Material, Matrix4, MeshBasicMaterial, MeshLambertMaterial, Quaternion, Raycaster, Scene,
  SphereGeometry, Vector2, Vector3, WebGLRenderer, type Object3D,
} from "three";
import type { Description } from "../api/types";
import { along, axisLength, slideGeometry, turnGeometry } from "./arc";
import { matrix, placed } from "./frames";
import type { Hit, Painter } from "./painter";
import type { Arrow, Picture } from "./picture";
import { shapeGroups, tint } from "./shapes";

/** Smallest half extent of a box, over the robot's extent: so that it is seen, and its matrix can be inverted. */
const THINNEST = 1.5e-3;

/** None if the browser has no WebGL. */
export function glPainter(canvas: HTMLCanvasElement): Painter | null {
  const wanted = { alpha: true, depth: true, stencil: false };
  const fast = canvas.getContext("webgl2", { ...wanted, antialias: true, failIfMajorPerformanceCaveat: true });
  // Without a graphics processor edges are smoothed only where nothing moves.
  const context = fast ?? canvas.getContext("webgl2", { ...wanted, antialias: false });
  return context && new GlPainter(canvas, context, fast !== null);
}

class GlPainter implements Painter {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly sun = new DirectionalLight(0xffffff, 2.2);
  private readonly robot = new Group();
  private readonly caster = new Raycaster();
  private model: Description | null = null;
  private boxes: InstancedMesh | null = null;
  private readonly local: Matrix4[] = [];
  private shapes: Group[] = [];
  private axes: InstancedMesh | null = null;
  private centres: InstancedMesh | null = null;
  private turns: InstancedMesh | null = null;
  private slides: InstancedMesh | null = null;
  private skeleton: LineSegments | null = null;
  private floor: GridHelper | null = null;
  private floorOf = "";
  private last: Picture | null = null;
  private size = "";

  constructor(
    readonly canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
    private readonly fast: boolean,
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
    const white = () => new MeshLambertMaterial({ color: 0xffffff });
    this.boxes = this.instanced(new BoxGeometry(1, 1, 1), white(), n);
    const rod = new CylinderGeometry(1, 1, 1, 4, 1, true).rotateX(Math.PI / 2);
    this.axes = this.instanced(rod, white(), Math.max(1, model.dofs.length));
    const over = new MeshBasicMaterial({ color: 0xffffff, depthTest: false, transparent: true, opacity: 0.9 });
    this.centres = this.instanced(new SphereGeometry(1, 14, 10), over, n);
    this.centres.renderOrder = 2;
    // Joints are inside of links: arrows are seen through them.
    const through = () => new MeshBasicMaterial({ color: 0xffffff, depthTest: false, transparent: true });
    this.turns = this.instanced(turnGeometry(), through(), Math.max(1, model.dofs.length));
    this.slides = this.instanced(slideGeometry(), through(), Math.max(1, model.dofs.length));
    this.turns.renderOrder = this.slides.renderOrder = 3;
    const lines = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(new Float32Array(6 * n), 3));
    this.skeleton = new LineSegments(lines, new LineBasicMaterial());
    this.skeleton.frustumCulled = false;
    this.robot.add(this.skeleton);
    this.shapes = shapeGroups(model);
    this.shapes.forEach((group) => this.robot.add(group));
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
    const at = new Matrix4();
    const colour = new Color();
    let shown = 0;
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
      boxes.setMatrixAt(k, boxed ? at.multiply(this.local[k]!) : NOTHING);
      boxes.setColorAt(k, colour.setHex(picture.colours[k] ?? 0));
      shown += 1;
    }
    this.flush(boxes, shown);
    boxes.computeBoundingSphere();
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
    const body = hit.instanceId ?? (hit.object.userData["body"] as number | undefined);
    return body === undefined ? null : { body, point: hit.point };
  }

  private paintAxes({ axes, overlays, scale, theme }: Picture): void {
    const mesh = this.axes!;
    const shown = overlays.has("axes") ? axes.slice(0, mesh.instanceMatrix.count) : [];
    const size = new Vector3(0.008 * scale, 0.008 * scale, axisLength(axes.length) * scale);
    shown.forEach(({ origin, direction, slides }, k) => {
      mesh.setMatrixAt(k, along(origin, direction, size));
      mesh.setColorAt(k, new Color(slides ? theme.green : theme.ink));
    });
    this.flush(mesh, shown.length);
  }

  private paintCentres({ places, overlays, scale, theme }: Picture, model: Description): void {
    const mesh = this.centres!;
    const heaviest = Math.max(...model.bodies.map((body) => body.mass), Number.MIN_VALUE);
    const shown = overlays.has("centres") ? model.bodies.length : 0;
    for (let k = 0; k < shown; k++) {
      const [body, place] = [model.bodies[k]!, places[k]];
      const size = place && body.mass > 0 ? 0.075 * scale * Math.max(0.25, Math.cbrt(body.mass / heaviest)) : 0;
      mesh.setMatrixAt(k, place ? new Matrix4().makeScale(size, size, size).setPosition(placed(place, body.centre)) : NOTHING);
      mesh.setColorAt(k, new Color(theme.purple));
    }
    this.flush(mesh, shown);
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

  private paintArrows({ arrows, overlays, scale, arrowColour }: Picture): void {
    const shown = overlays.has("arrows") ? arrows : [];
    const put = (mesh: InstancedMesh, list: Arrow[], length: number) => {
      list.forEach(({ origin, direction, rate }, k) => {
        const towards = rate < 0 ? direction.clone().negate() : direction;
        mesh.setMatrixAt(k, along(origin, towards, length * scale * Math.sqrt(Math.abs(rate))));
        mesh.setColorAt(k, new Color(arrowColour));
      });
      this.flush(mesh, list.length);
    };
    put(this.turns!, shown.filter(({ slides }) => !slides), 0.17);
    put(this.slides!, shown.filter(({ slides }) => slides), 0.2);
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
      this.floor.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), up));
      const [first] = this.last?.places ?? [];
      // Grid lines stand at whole cells, the floor through the world's origin.
      if (first) this.floor.position.copy(flattened(new Vector3(first[0], first[1], first[2]), up, cell));
      this.scene.add(this.floor);
      this.floorOf = key;
    }
    if (this.floor) this.floor.visible = overlays.has("floor");
  }

  private instanced(geometry: BufferGeometry, material: Material, count: number): InstancedMesh {
    const mesh = new InstancedMesh(geometry, material, count);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    mesh.frustumCulled = false;
    this.robot.add(mesh);
    return mesh;
  }

  private flush(mesh: InstancedMesh, count: number): void {
    mesh.count = count;
    mesh.visible = count > 0;
    mesh.instanceMatrix.needsUpdate = true;
    if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
  }
}

const NOTHING = new Matrix4().makeScale(0, 0, 0);

/** A point's shadow on the floor, at a whole cell. */
function flattened(point: Vector3, up: Vector3, cell: number): Vector3 {
  return point.addScaledVector(up, -point.dot(up)).divideScalar(cell).round().multiplyScalar(cell);
}

function dispose(group: Group): void {
  group.traverse((object) => {
    const mesh = object as Partial<InstancedMesh>;
    mesh.geometry?.dispose();
    for (const material of [mesh.material ?? []].flat()) material.dispose();
    if (object instanceof InstancedMesh) object.dispose();
  });
  group.clear();
}
