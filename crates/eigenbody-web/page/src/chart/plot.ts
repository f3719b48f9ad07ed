/** Curves on axes, as SVG. Points that can be pressed are reached by one Tab and then by arrow keys. */

import { h, svg } from "../dom";
import { extent, scale, type Scale } from "./scale";

export interface Point {
  x: number;
  y: number | null;
  /** What a press does, and what the point is called then. */
  press?: () => void;
  label?: string;
  chosen?: boolean;
}

export interface Curve {
  name: string;
  points: Point[];
  /** Its place in the palette: colour, dashes and marker. */
  style: number;
  line: boolean;
  markers: boolean;
  /** Curves of several kinds: dashes and filling tell the kind, colour and shape the rest. */
  kind?: number;
}

export interface Drawing {
  label: string;
  x: { label: string; log: boolean };
  y: { label: string; log: boolean };
  curves: Curve[];
  /** A vertical line at x. */
  cursor?: number | null;
  /** What a press anywhere does. */
  pick?: (x: number) => void;
  height: number;
}

const DASHES = ["", "9 4", "2 3", "9 3 2 3", "14 4", "5 3", "9 3 2 3 2 3"];

function dashes({ style, kind }: { style: number; kind?: number | undefined }): string | null {
  return DASHES[(kind ?? style) % DASHES.length] || null;
}

const MARGIN = { left: 58, right: 14, top: 10, bottom: 40 };

export class Plot {
  readonly element = h("div", { class: "plot" });
  private drawing: Drawing | null = null;
  private width = 0;

  constructor() {
    new ResizeObserver(() => this.element.clientWidth !== this.width && this.render()).observe(this.element);
  }

  show(drawing: Drawing): void {
    this.drawing = drawing;
    this.render();
  }

  private render(): void {
    this.width = this.element.clientWidth;
    if (!this.drawing || this.width === 0) return;
    const focused = this.element.contains(document.activeElement) ? document.activeElement?.getAttribute("data-key") : null;
    this.element.replaceChildren(draw(this.drawing, this.width));
    if (focused) this.element.querySelector<SVGElement>(`[data-key="${CSS.escape(focused)}"]`)?.focus();
  }
}

function draw(drawing: Drawing, width: number): Element {
  const { x, y, curves, height, label } = drawing;
  const points = curves.flatMap((curve) => curve.points);
  const pressable = points.some((point) => point.press);
  const [ex, ey] = [extent(points.map((p) => p.x), x.log), extent(points.map((p) => p.y), y.log)];
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: pressable ? "group" : "img", "aria-label": label });
  if (!ex || !ey) {
    root.append(svg("text", { x: width / 2, y: height / 2, "text-anchor": "middle", class: "soft" }, "nothing to draw"));
    return root;
  }
  const [left, right, top, bottom] = [MARGIN.left, width - MARGIN.right, MARGIN.top, height - MARGIN.bottom];
  const sx = scale(ex, x.log, left + 6, right - 6, Math.max(3, Math.min(8, width / 80)));
  const sy = scale(ey, y.log, bottom - 6, top + 6, Math.max(3, Math.min(7, height / 40)));
  root.append(grid(sx, sy, { left, right, top, bottom }));
  root.append(
    svg("text", { x: (left + right) / 2, y: height - 6, "text-anchor": "middle", class: "title" }, x.label),
    svg("text", { x: 0, y: 0, "text-anchor": "middle", class: "title", transform: `translate(13 ${(top + bottom) / 2}) rotate(-90)` }, y.label),
  );
  const { cursor, pick } = drawing;
  if (cursor !== null && cursor !== undefined) root.append(svg("line", { class: "cursor", x1: sx.at(cursor), x2: sx.at(cursor), y1: top, y2: bottom }));
  curves.forEach((curve, k) => root.append(drawCurve(curve, k, sx, sy, y.log)));
  if (pick) {
    root.classList.add("pickable");
    root.addEventListener("click", (event) => {
      const place = event.clientX - root.getBoundingClientRect().left;
      pick(Math.min(ex.high, Math.max(ex.low, sx.back(place))));
    });
  }
  if (pressable) walk(root);
  return root;
}

function grid(sx: Scale, sy: Scale, { left, right, top, bottom }: Record<"left" | "right" | "top" | "bottom", number>): SVGGElement {
  const group = svg("g", { class: "grid", "aria-hidden": "true" });
  for (const { value, label } of sx.ticks) {
    const at = sx.at(value);
    group.append(svg("line", { x1: at, x2: at, y1: top, y2: bottom }), svg("text", { x: at, y: bottom + 16, "text-anchor": "middle" }, label));
  }
  for (const { value, label } of sy.ticks) {
    const at = sy.at(value);
    group.append(svg("line", { x1: left, x2: right, y1: at, y2: at }), svg("text", { x: left - 6, y: at + 4, "text-anchor": "end" }, label));
  }
  group.append(svg("rect", { x: left, y: top, width: right - left, height: bottom - top, class: "frame" }));
  return group;
}

function drawCurve(curve: Curve, k: number, sx: Scale, sy: Scale, log: boolean): SVGGElement {
  const { points, style, line, markers, kind } = curve;
  const group = svg("g", { class: `curve c${style % 7}${kind === 0 ? " filled" : ""}` });
  const seen = points.filter((p): p is Point & { y: number } => p.y !== null && Number.isFinite(p.y) && (!log || p.y > 0));
  if (line) {
    let path = "";
    let broken = true;
    for (const p of points) {
      const drawn = p.y !== null && Number.isFinite(p.y) && (!log || p.y > 0);
      if (drawn) path += `${broken ? "M" : "L"}${sx.at(p.x).toFixed(1)} ${sy.at(p.y!).toFixed(1)}`;
      broken = !drawn;
    }
    group.append(svg("path", { d: path, "stroke-dasharray": dashes(curve) }));
  }
  if (!markers) return group;
  seen.forEach((p, at) => {
    const [cx, cy] = [sx.at(p.x), sy.at(p.y)];
    const mark = marker(style, cx, cy, p.chosen ? 6 : 3.6);
    if (p.chosen) mark.classList.add("chosen");
    if (!p.press) {
      group.append(mark);
      return;
    }
    const key = `${k}-${at}`;
    const press = p.press;
    const button = svg("g", {
      role: "button", class: "point", tabindex: -1, "data-key": key, "aria-label": p.label ?? "", "aria-pressed": p.chosen ? "true" : "false",
      on: {
        click: press,
        keydown: (event: KeyboardEvent) => {
          if (event.key !== "Enter" && event.key !== " ") return;
          event.preventDefault();
          press();
        },
      },
    }, svg("circle", { cx, cy, r: 9, class: "halo" }), mark, svg("title", {}, p.label ?? ""));
    group.append(button);
  });
  return group;
}

/** One shape for every place in the palette. */
export function marker(style: number, x: number, y: number, r: number): SVGElement {
  const at = (points: readonly (readonly [number, number])[]) => points.map(([dx, dy]) => `${(x + dx * r).toFixed(1)},${(y + dy * r).toFixed(1)}`).join(" ");
  switch (style % 7) {
    case 0:
      return svg("circle", { class: "mark", cx: x, cy: y, r });
    case 1:
      return svg("rect", { class: "mark", x: x - 0.9 * r, y: y - 0.9 * r, width: 1.8 * r, height: 1.8 * r });
    case 2:
      return svg("polygon", { class: "mark", points: at([[-1.1, 0.8], [1.1, 0.8], [0, -1.2]]) });
    case 3:
      return svg("polygon", { class: "mark", points: at([[-1.2, 0], [0, 1.2], [1.2, 0], [0, -1.2]]) });
    case 4:
      return svg("polygon", { class: "mark", points: at([[-1.1, -0.8], [1.1, -0.8], [0, 1.2]]) });
    case 5:
      return svg("path", { class: "mark", d: `M${x - r} ${y - r}L${x + r} ${y + r}M${x - r} ${y + r}L${x + r} ${y - r}` });
    default:
      return svg("path", { class: "mark", d: `M${x - 1.2 * r} ${y}L${x + 1.2 * r} ${y}M${x} ${y - 1.2 * r}L${x} ${y + 1.2 * r}` });
  }
}

/** Arrow keys go from point to point: along a curve, or to the nearest of another. */
function walk(root: SVGElement): void {
  const all = [...root.querySelectorAll<SVGGElement>(".point")];
  const first = all.find((point) => point.getAttribute("aria-pressed") === "true") ?? all[0];
  first?.setAttribute("tabindex", "0");
  root.addEventListener("keydown", (event) => {
    const at = all.indexOf(document.activeElement as SVGGElement);
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    const turn = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (at < 0 || (step === undefined && turn === undefined)) return;
    event.preventDefault();
    const next = step === undefined ? neighbour(all, at, turn!) : all[at + step];
    if (!next) return;
    all[at]!.setAttribute("tabindex", "-1");
    next.setAttribute("tabindex", "0");
    next.focus();
  });
}

function neighbour(all: SVGGElement[], at: number, turn: number): SVGGElement | undefined {
  const [curve, place] = (all[at]!.getAttribute("data-key") ?? "").split("-").map(Number) as [number, number];
  const found = (k: number) => all.find((point) => point.getAttribute("data-key") === `${curve + turn}-${k}`);
  for (let k = place; k >= 0; k--) {
    const point = found(k);
    if (point) return point;
  }
  return undefined;
}

/** The names of curves with their looks. */
export function legend(curves: readonly Omit<Curve, "points">[]): HTMLUListElement {
  return h("ul", { class: "legend" }, ...curves.map(({ name, style, line, markers, kind }) =>
    h("li", {},
      svg("svg", { width: 34, height: 14, viewBox: "0 0 34 14", "aria-hidden": "true", class: "plot-key" },
        svg("g", { class: `curve c${style % 7}${kind === 0 ? " filled" : ""}` },
          line && svg("path", { d: "M1 7L33 7", "stroke-dasharray": dashes({ style, kind }) }),
          markers && marker(style, 17, 7, 3.6))),
      name)));
}
