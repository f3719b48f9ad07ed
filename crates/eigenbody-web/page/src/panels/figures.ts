/** The papers' figures, each point a robot to be seen. */

import type { Figure, FigurePoint } from "../api/types";
import { legend, Plot, type Curve } from "../chart/plot";
import { h, select } from "../dom";
import type { Explorer } from "../explorer";
import { shown } from "../math/number";

export function figures(explorer: Explorer): HTMLElement {
  const { figures: all } = explorer.start;
  const plot = new Plot();
  const names = h("div", {});
  const title = h("p", {});
  const seen = h("p", { class: "small soft" });
  const status = h("p", { class: "readout", role: "status" });
  const known = new Map<string, Promise<Figure>>();
  let chosen: FigurePoint | null = null;
  let shownFigure: Figure | null = null;

  const load = async () => {
    const id = explorer.state.figure ?? all[0]?.id;
    if (explorer.state.tab !== "figures" || !id || shownFigure?.id === id) return;
    status.textContent = "Computing the figure…";
    await explorer.attempt(async () => {
      const asked = known.get(id) ?? explorer.client.figure(id);
      known.set(id, asked);
      const figure = await asked.catch((error: unknown) => {
        known.delete(id);
        throw error;
      });
      if ((explorer.state.figure ?? all[0]?.id) !== id) return;
      shownFigure = figure;
      status.textContent = "Press a point to see its robot. Arrow keys go from point to point, Enter shows it.";
      draw();
    });
  };
  const draw = () => {
    const figure = shownFigure;
    if (!figure) return;
    title.textContent = figure.title;
    seen.textContent = `${figure.seen} ${figure.paper}`;
    const looks = curveLooks(figure.curves.map(({ name }) => name));
    const curves: Curve[] = figure.curves.map(({ name, points }, k) => ({
      name, ...looks[k]!, line: true, markers: true,
      points: points.map((point) => ({
        x: point.x, y: point.y, chosen: point === chosen,
        ...(point.source ? { label: `${name}: ${figure.x.label} ${Number.isInteger(point.x) ? point.x : shown(point.x, 4)}, ${figure.y.label} ${shown(point.y, 4)}`, press: () => void go(point, name) } : {}),
      })),
    }));
    plot.show({ label: `${figure.id}: ${figure.title}`, x: figure.x, y: figure.y, curves, height: 340 });
    names.replaceChildren(legend(curves));
  };
  const go = async (point: FigurePoint, curve: string) => {
    chosen = point;
    draw();
    const opened = await explorer.open(point.source, point.options, undefined, { config: point.at });
    if (opened) status.textContent = `${curve}: ${explorer.model?.name ?? ""} at ${withPi(point.at)}, drawn at ${shown(point.y)}.`;
  };
  const choose = select("Figure", all.map(({ id, title: words }) => ({ value: id, label: `${paper(id)}: ${words}` })), explorer.state.figure ?? all[0]?.id ?? "", (id) => {
    chosen = null;
    explorer.update({ figure: id }, "figure");
  });
  explorer.on(["tab", "figure"], () => void load());
  return h("section", { class: "block", "aria-label": "Figures" }, h("h2", {}, "Figures of the papers, live"), choose, title, names, plot.element, status, seen);
}

/** Looks of curves named `kind, parameter`: colour and shape follow the parameter, dashes and filling the kind. */
export function curveLooks(names: readonly string[]): { style: number; kind?: number }[] {
  const parts = names.map((name) => name.split(", "));
  if (!parts.every(({ length }) => length === 2)) return names.map((_, style) => ({ style }));
  const [kinds, parameters] = [0, 1].map((at) => [...new Set(parts.map((part) => part[at]))]) as [string[], string[]];
  return parts.map(([kind, parameter]) => ({ style: parameters.indexOf(parameter!), kind: kinds.indexOf(kind!) }));
}

/** Multiples of π as people write them: `curl(1.5707963267948966)` is `curl(π/2)`. */
export function withPi(text: string): string {
  return text.replace(/\d+\.\d{6,}/g, (digits) => {
    const x = Number(digits);
    for (let below = 1; below <= 16; below++) {
      const above = Math.round((x / Math.PI) * below);
      if (above > 0 && Math.abs((above * Math.PI) / below - x) < 4e-16 * x) return `${above === 1 ? "" : above}π${below === 1 ? "" : `/${below}`}`;
    }
    return digits;
  });
}

/** `F-fig6` as people say it. */
function paper(id: string): string {
  const [author, figure = ""] = id.split("-");
  return `${author === "F" ? "Featherstone" : "Shah & Saha"}, figure ${figure.replace("fig", "")}`;
}
