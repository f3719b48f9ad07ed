/** The view: a painter, an eye, and what pointers and keys do to them. */

import type { Pose } from "../api/types";
import { h } from "../dom";
import type { Explorer } from "../explorer";
import { turnedTo } from "../panels/coordinates";
import { rounded } from "../state/state";
import { calm, onThemeChange, theme, type Theme } from "../theme";
import { holder, onScreen, stepFor, within } from "./drag";
import { Eye } from "./eye";
import { flatPainter } from "./flat";
import { placed, within as inBody } from "./frames";
import { glPainter } from "./gl";
import type { Hit, Painter } from "./painter";
import { arrows, carried, colours, inWorld, modeColour, type Axis } from "./picture";
import { Swing } from "./swing";

const KEYS: Record<string, [number, number]> = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };

/** How long nothing must move before edges are smoothed (ms). */
const REST = 200;
/** Of the time that a drawing keeps the page waiting, the part that the page then has for all else. */
const RESPITE = 0.5;
/** The longest that a drawing is taken to last (ms): a page in the background is not slow, but asleep. */
const SLOWEST = 100;

export class Stage {
  readonly element: HTMLElement;
  /** What a reader must know about the painter, if anything. */
  readonly notice: string | null;
  private readonly canvas: HTMLCanvasElement;
  private readonly painter: Painter;
  private readonly eye = new Eye();
  readonly swing: Swing;
  private theme: Theme = theme();
  private axes: Axis[] = [];
  private framed: string | null = null;
  private due = false;
  private rest: ReturnType<typeof setTimeout> | undefined;
  private before = 0;
  /** When the next drawing may begin (ms). */
  private free = 0;
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private grabbed: { hit: Hit; joint: number; local: [number, number, number] } | null = null;

  constructor(private readonly explorer: Explorer) {
    this.canvas = stageCanvas();
    const gl = glPainter(this.canvas, (k) => explorer.client.mesh(k), () => this.draw());
    if (!gl) {
      // A canvas that was asked for WebGL is lost to everything else.
      const fresh = stageCanvas();
      this.painter = flatPainter(fresh);
      this.canvas = fresh;
    } else {
      this.painter = gl;
    }
    this.notice = gl ? null : "This browser has no WebGL: the robot is drawn flat, as boxes.";
    this.element = h("div", { class: "stage" }, this.canvas);
    this.swing = new Swing(explorer, () => this.draw());
    this.listen();
    new ResizeObserver(() => this.draw()).observe(this.element);
    onThemeChange(() => {
      this.theme = theme();
      this.draw();
    });
    explorer.on("model", () => this.load());
    explorer.on("evaluation", () => this.evaluated());
    explorer.on(["view", "hover"], () => {
      this.swing.follow();
      this.draw();
    });
  }

  /**
   * Draws before the next frame is shown, or a little later where drawing is slow; once more, finely, when nothing has moved for a while.
   *
   * What changes until then is drawn together.
   */
  draw(): void {
    clearTimeout(this.rest);
    if (this.due) return;
    this.due = true;
    const next = () => requestAnimationFrame((now) => {
      this.due = false;
      const begun = performance.now();
      this.frame(now, false);
      // A browser without a graphics processor draws after this, with the page standing still.
      setTimeout(() => (this.free = begun + (1 + RESPITE) * Math.min(SLOWEST, performance.now() - begun)));
      clearTimeout(this.rest);
      this.rest = setTimeout(() => requestAnimationFrame((then) => this.due || this.frame(then, true)), REST);
    });
    const pause = this.free - performance.now();
    if (pause > 1) setTimeout(next, pause);
    else next();
  }

  private load(): void {
    const { model } = this.explorer;
    if (!model) return;
    this.painter.load(model);
    this.eye.load(model);
  }

  private evaluated(): void {
    const { model, evaluation } = this.explorer;
    if (!model || !evaluation?.places) return;
    this.axes = carried(model, evaluation);
    // An edited robot keeps its place on the screen; another one is looked at anew.
    const robot = `${model.name} ${model.nq} ${model.options.base}`;
    if (this.framed !== robot) {
      this.eye.frame(model, evaluation.places);
      this.framed = robot;
    }
    this.swing.follow();
    this.draw();
  }

  /** Takes in the whole robot as it stands. */
  fit(): void {
    const { model, evaluation, state } = this.explorer;
    if (model && evaluation?.places) this.eye.frame(model, evaluation.places);
    this.explorer.update({ eye: { ...state.eye, distance: 0, target: [0, 0, 0] } }, "view");
  }

  private frame(now: number, fine: boolean): void {
    const { model, evaluation, state, hovered } = this.explorer;
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!model || !evaluation?.places || width === 0 || height === 0) return;
    const playing = state.swinging && !calm();
    if (playing) this.swing.advance(Math.min(0.1, (now - this.before) / 1000));
    this.before = now;
    const places: readonly Pose[] = this.swing.places() ?? evaluation.places;
    if (places.length !== model.bodies.length) return;
    this.painter.resize(width, height, fine);
    this.eye.state = state.eye;
    this.eye.place(width / height);
    const axes = inWorld(model, this.axes, places);
    this.painter.paint({
      camera: this.eye.camera,
      places,
      colours: colours(model, evaluation, state, this.theme, hovered),
      overlays: state.overlays,
      axes,
      arrows: state.overlays.has("arrows") ? arrows(model, evaluation, axes, state) : [],
      arrowColour: modeColour(state, this.theme),
      shapes: state.shapes,
      scale: Math.min(this.eye.size, this.eye.distance / 3.6),
      up: this.eye.upward,
      size: this.eye.size,
      theme: this.theme,
    });
    if (playing) this.draw();
  }

  private listen(): void {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"] as const) canvas.addEventListener(end, (event) => this.release(event));
    canvas.addEventListener("pointerleave", () => this.grabbed ?? this.explorer.hover(null));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("dblclick", () => this.fit());
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.look(this.eye.zoomed(Math.exp(0.0012 * event.deltaY)));
    }, { passive: false });
  }

  private look(eye: typeof this.eye.state): void {
    // Two fingers may move before the next drawing: each goes on from where the other has left the camera.
    this.eye.state = rounded(eye);
    this.explorer.update({ eye: this.eye.state }, "view");
  }

  private place(event: PointerEvent): { x: number; y: number } {
    const box = this.canvas.getBoundingClientRect();
    return { x: (2 * (event.clientX - box.left)) / box.width - 1, y: 1 - (2 * (event.clientY - box.top)) / box.height };
  }

  private press(event: PointerEvent): void {
    const at = this.place(event);
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, at);
    const { model, evaluation, state } = this.explorer;
    const hit = event.button === 0 && this.pointers.size === 1 && !event.shiftKey && !state.swinging ? this.painter.pick(at.x, at.y) : null;
    const joint = hit && model ? holder(model, hit.body) : null;
    const place = hit && evaluation?.places?.[hit.body];
    this.grabbed = hit && place && joint !== null ? { hit, joint, local: inBody(place, hit.point).toArray() } : null;
    this.canvas.classList.toggle("grabbing", this.grabbed !== null);
    if (this.grabbed) this.explorer.hover(joint);
  }

  private move(event: PointerEvent): void {
    const at = this.place(event);
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      if (event.pointerType === "mouse") this.point(at);
      return;
    }
    const [dx, dy] = [at.x - before.x, at.y - before.y];
    const others = [...this.pointers.entries()].filter(([id]) => id !== event.pointerId).map(([, other]) => other);
    this.pointers.set(event.pointerId, at);
    if (this.grabbed) this.drag(dx, dy);
    else if (others[0]) this.pinch(before, at, others[0]);
    else if (event.shiftKey || event.buttons & 6) this.look(this.eye.shifted((-dx / 2) * this.eye.camera.aspect, -dy / 2));
    else this.look(this.eye.turned(-1.6 * dx * Math.max(1, this.eye.camera.aspect), -1.6 * dy));
  }

  private release(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    this.grabbed = null;
    this.canvas.classList.remove("grabbing");
  }

  /** Shows which joint a drag would move. */
  private point(at: { x: number; y: number }): void {
    const { model } = this.explorer;
    const hit = this.painter.pick(at.x, at.y);
    const joint = hit && model ? holder(model, hit.body) : null;
    this.canvas.classList.toggle("grab", joint !== null);
    this.explorer.hover(joint);
  }

  private pinch(before: { x: number; y: number }, at: { x: number; y: number }, other: { x: number; y: number }): void {
    const [was, is] = [before, at].map((p) => Math.hypot(p.x - other.x, p.y - other.y)) as [number, number];
    if (was > 0 && is > 0) this.look(this.eye.zoomed(was / is));
  }

  private drag(dx: number, dy: number): void {
    const { model, evaluation } = this.explorer;
    const { grabbed } = this;
    const joint = grabbed && model?.joints[grabbed.joint];
    const place = grabbed && evaluation?.places?.[grabbed.hit.body];
    if (!joint || !place || !model) return;
    const axes = inWorld(model, this.axes, evaluation.places ?? []);
    const point = placed(place, grabbed.local);
    // Of several DoFs the one that goes the pointer's way best.
    const steps = joint.dofs.map((d) => {
      const rate = onScreen(axes[d]!, point, this.eye.camera);
      const along = Math.abs(rate.x * dx + rate.y * dy) / Math.max(Math.hypot(rate.x, rate.y), 1e-12);
      return { d, along, step: stepFor(rate, dx, dy, 0.12 / this.eye.size ** (axes[d]!.slides ? 1 : 0)) };
    });
    const best = steps.reduce((a, b) => (b.along > a.along ? b : a));
    const q = [...this.explorer.q];
    if (joint.nq === 1) {
      q[joint.q] = within(joint, (q[joint.q] ?? 0) + best.step);
      this.explorer.pose(q);
    } else if (joint.kind === "spherical") {
      this.explorer.pose(turnedTo(q, joint, joint.dofs.indexOf(best.d), best.step));
    } else if (joint.nq === joint.dofs.length) {
      const k = joint.q + joint.dofs.indexOf(best.d);
      q[k] = (q[k] ?? 0) + best.step;
      this.explorer.pose(q);
    }
  }

  private key(event: KeyboardEvent): void {
    const turn = KEYS[event.key];
    if (turn && event.shiftKey) this.look(this.eye.shifted(turn[0] / 2, turn[1] / 2));
    else if (turn) this.look(this.eye.turned(...turn));
    else if (event.key === "+" || event.key === "=") this.look(this.eye.zoomed(0.87));
    else if (event.key === "-") this.look(this.eye.zoomed(1.15));
    else if (event.key === "0") this.fit();
    else return;
    event.preventDefault();
  }
}

function stageCanvas(): HTMLCanvasElement {
  return h("canvas", {
    tabindex: 0,
    role: "application",
    "aria-roledescription": "view of the robot",
    "aria-label": "Robot. Arrow keys turn the view, with Shift they move it; plus and minus zoom, 0 takes in everything. Joints are moved by the sliders.",
  });
}
