/** κ and κ′ along the line between two configurations, A and B. */

import { button, fresh, h } from "../dom";
import { legend, Plot } from "../chart/plot";
import type { Path } from "../api/types";
import type { Explorer } from "../explorer";
import { shown } from "../math/number";
import { Latest } from "../state/latest";

const POINTS = 121;
const CURVES = [
  { name: "κ", style: 0, line: true, markers: false },
  { name: "κ′", style: 1, line: true, markers: false },
];

export function line(explorer: Explorer): HTMLElement {
  const plot = new Plot();
  let found: { path: Path; a: number[]; b: number[] } | null = null;
  let t: number | null = null;
  const text = h("p", { class: "readout" });
  const slider = h("input", { type: "range", id: fresh("along"), min: 0, max: 1, step: 0.005, value: 0, on: { input: () => go(Number(slider.value)) } });
  const along = h("div", { class: "field along" }, h("label", { for: slider.id }, "From A to B"), slider);

  const paths = new Latest(
    (asked: { id: string; a: number[]; b: number[]; points: number; metric: string }) =>
      explorer.client.path(asked.id, { from: asked.a, to: asked.b, points: asked.points, metric: asked.metric }),
    (path, { id, a, b }) => {
      if (id !== explorer.model?.id) return;
      found = { path, a, b };
      draw();
    },
    (error) => explorer.fail(error),
  );
  const walk = new Latest(
    (asked: { id: string; a: number[]; b: number[]; t: number }) => explorer.client.between(asked.id, asked.a, asked.b, asked.t),
    ({ q }, { id }) => {
      if (id !== explorer.model?.id) return;
      moved = q;
      explorer.pose(q);
    },
    (error) => explorer.fail(error),
  );
  let moved: number[] | null = null;

  const ends = () => {
    const model = explorer.model;
    const { a, b } = explorer.state;
    return model ? { a: a ?? model.q0, b: b ?? explorer.q, model } : null;
  };
  const ask = () => {
    const now = ends();
    if (!now || explorer.state.tab !== "line") return;
    const points = Math.min(POINTS, now.model.limits.path);
    paths.put({ id: now.model.id, a: now.a, b: now.b, points, metric: explorer.state.metric });
  };
  const go = (to: number) => {
    const now = ends();
    if (!now) return;
    t = to;
    // The end that follows the robot stays where it is while the robot goes along the line.
    if (!explorer.state.b) explorer.state = { ...explorer.state, b: now.b };
    walk.put({ id: now.model.id, a: now.a, b: now.b, t: to });
    draw();
  };
  const draw = () => {
    if (!found) return;
    const { path } = found;
    slider.value = String(t ?? 0);
    slider.setAttribute("aria-valuetext", `${shown(100 * (t ?? 0), 3)} percent of the way`);
    const series = [path.kappa, path.kappa_weighted];
    plot.show({
      label: `Condition numbers along the line from A to B: κ from ${shown(path.kappa[0], 4)} to ${shown(path.kappa.at(-1), 4)}`,
      x: { label: "part of the way from A to B", log: false },
      y: { label: "condition number", log: true },
      curves: CURVES.map((curve, k) => ({ ...curve, points: path.t.map((x, at) => ({ x, y: series[k]?.[at] ?? null })) })),
      cursor: t,
      pick: go,
      height: 220,
    });
    const numbers = path.kappa.filter((x) => x !== null);
    text.textContent = numbers.length > 0 ? `κ between ${shown(Math.min(...numbers), 4)} and ${shown(Math.max(...numbers), 4)} along the line` : "";
  };
  const set = (end: "a" | "b", q: number[] | null) => {
    t = null;
    explorer.update({ [end]: q }, "ends");
  };
  explorer.on(["ends", "tab"], ask);
  explorer.on("model", () => {
    found = t = null;
    ask();
  });
  // Without a B of its own the line ends where the robot is.
  explorer.on("evaluation", () => {
    if (!explorer.state.b) ask();
    else if (moved && explorer.q !== moved && t !== null) {
      t = null;
      draw();
    }
  });
  explorer.on("view", ask);
  return h("section", { class: "block", "aria-label": "Along a line" },
    h("h2", {}, "κ along a line between two configurations"),
    h("div", { class: "row" },
      button("A is here", () => set("a", explorer.q)),
      button("B is here", () => set("b", explorer.q)),
      button("Go to A", () => go(0)),
      button("Go to B", () => go(1)),
      button("B follows the robot", () => set("b", null))),
    legend(CURVES), plot.element, along, text);
}
