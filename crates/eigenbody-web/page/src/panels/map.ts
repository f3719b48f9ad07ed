/** κ over two joints, all others where they are. */

import { button, h, select } from "../dom";
import { colourBar, Raster } from "../chart/raster";
import { extent, power } from "../chart/scale";
import type { Joint, KappaMap } from "../api/types";
import type { Explorer } from "../explorer";
import { logPlace } from "../math/colour";
import { shown } from "../math/number";
import { Latest } from "../state/latest";

const RESOLUTION = 41;

interface Asked {
  id: string;
  q: number[];
  dofs: [number, number];
  resolution: number;
  metric: string;
}

export function map(explorer: Explorer): HTMLElement {
  const raster = new Raster("Press a square to go there; arrow keys and Enter do the same.");
  const axes = h("div", { class: "row" });
  const scale = h("div", {});
  const across = h("p", { class: "small soft" });
  let found: { map: KappaMap; asked: Asked } | null = null;
  let measure: "kappa" | "kappa_weighted" = "kappa";
  /** The joints besides the two, for which the map holds. */
  let held = "";

  const maps = new Latest(
    ({ id, ...asked }: Asked) => explorer.client.map(id, asked),
    (answer, asked) => {
      if (asked.id !== explorer.model?.id) return;
      found = { map: answer, asked };
      draw();
    },
    (error) => explorer.fail(error),
  );
  const free = (): { joint: Joint; index: number }[] =>
    explorer.model?.joints.flatMap((joint, index) => (joint.nq === 1 && joint.dofs.length === 1 && !joint.follows ? [{ joint, index }] : [])) ?? [];
  const pair = () => {
    const joints = free();
    const named = (name: string | undefined, otherwise: number) => joints.find(({ joint }) => joint.name === name) ?? joints[otherwise];
    const [x, y] = [named(explorer.state.map?.[0], joints.length > 2 ? 1 : 0), named(explorer.state.map?.[1], joints.length > 2 ? 2 : 1)];
    return x && y && x !== y ? { x, y } : null;
  };
  const ask = () => {
    const { model, state } = explorer;
    const two = pair();
    if (!model || !two || state.tab !== "line") return;
    const q = explorer.q;
    const rest = JSON.stringify([model.id, two.x.index, two.y.index, state.metric, q.toSpliced(two.x.joint.q, 1, 0).toSpliced(two.y.joint.q, 1, 0)]);
    if (rest === held) return;
    held = rest;
    maps.put({ id: model.id, q, dofs: [two.x.index, two.y.index], resolution: Math.min(RESOLUTION, model.limits.map), metric: state.metric });
  };
  const here = () => {
    const two = pair();
    if (!found || !two) return null;
    const nearest = (values: number[], x: number) => values.reduce((best, value, k) => (Math.abs(value - x) < Math.abs(values[best]! - x) ? k : best), 0);
    const q = explorer.q;
    return { column: nearest(found.map.x, q[two.x.joint.q] ?? 0), row: nearest(found.map.y, q[two.y.joint.q] ?? 0) };
  };
  const draw = () => {
    const two = pair();
    if (!found || !two) return;
    const { x, y } = found.map;
    const values = found.map[measure];
    const range = extent(values.flat(), true);
    const symbol = measure === "kappa" ? "κ" : "κ′";
    if (range) scale.replaceChildren(colourBar(`${symbol} = ${range.low < 1e4 ? shown(range.low, 3) : power(range.low)}`, range.high < 1e4 ? shown(range.high, 3) : power(range.high)));
    across.textContent = `Across: ${two.x.joint.name} from ${shown(x[0], 3)} to ${shown(x.at(-1), 3)} ${two.x.joint.unit}. Upwards: ${two.y.joint.name} from ${shown(y[0], 3)} to ${shown(y.at(-1), 3)} ${two.y.joint.unit}.`;
    raster.show({
      label: `${symbol} over ${two.x.joint.name} and ${two.y.joint.name}`,
      rows: y.length,
      columns: x.length,
      upward: true,
      value: (row, column) => {
        const kappa = values[row]?.[column];
        return range && kappa ? logPlace(kappa, range.low, range.high) : null;
      },
      say: (row, column) => `${two.x.joint.name} ${shown(x[column], 3)} ${two.x.joint.unit}, ${two.y.joint.name} ${shown(y[row], 3)} ${two.y.joint.unit}: ${symbol} = ${shown(values[row]?.[column])}`,
      press: (row, column) => explorer.pose(explorer.q.with(two.x.joint.q, x[column]!).with(two.y.joint.q, y[row]!)),
      mark: here(),
    });
  };
  const choose = () => {
    const joints = free();
    const two = pair();
    raster.element.hidden = scale.hidden = two === null;
    if (!two) {
      axes.replaceChildren(h("p", { class: "soft" }, "This needs two joints of one coordinate."));
      return;
    }
    const choices = joints.map(({ joint }) => ({ value: joint.name, label: joint.name }));
    const put = (change: [string, string]) => change[0] !== change[1] && explorer.update({ map: change }, "map");
    axes.replaceChildren(
      select("Across", choices, two.x.joint.name, (name) => put([name, name === two.y.joint.name ? two.x.joint.name : two.y.joint.name])),
      select("Upwards", choices, two.y.joint.name, (name) => put([name === two.x.joint.name ? two.y.joint.name : two.x.joint.name, name])),
      select("Of", [{ value: "kappa", label: "κ" }, { value: "kappa_weighted", label: "κ′" }], measure, (value) => {
        measure = value === "kappa" ? "kappa" : "kappa_weighted";
        draw();
      }),
      button("Draw anew", () => {
        held = "";
        ask();
      }));
  };
  let rest: ReturnType<typeof setTimeout> | undefined;
  explorer.on("model", () => {
    found = null;
    held = "";
    choose();
    ask();
  });
  explorer.on("map", () => {
    choose();
    ask();
  });
  explorer.on(["tab", "view"], ask);
  explorer.on("evaluation", () => {
    if (explorer.state.tab !== "line") return;
    draw();
    // A map is many evaluations: it waits until the robot rests.
    clearTimeout(rest);
    rest = setTimeout(ask, 250);
  });
  return h("section", { class: "block", "aria-label": "Map over two joints" }, h("h2", {}, "κ over two joints"), axes, raster.element, across, scale);
}
