/** The softest and the stiffest mode: which joints move. */

import type { Description, Mode } from "../api/types";
import { h } from "../dom";
import type { Explorer } from "../explorer";
import { shown } from "../math/number";
import type { ModeChoice } from "../state/state";

const SHOWN = 7;
/** A smaller share is part of the rest. */
const LEAST = 5e-4;

export function modes(explorer: Explorer): HTMLElement {
  const [soft, stiff] = [h("div", { class: "mode softest" }), h("div", { class: "mode stiffest" })];
  const update = () => {
    const { model, evaluation } = explorer;
    if (!model || !evaluation) return;
    soft.replaceChildren(...content("softest", model, evaluation.softest, evaluation.lambda_min, evaluation.unit));
    stiff.replaceChildren(...content("stiffest", model, evaluation.stiffest, evaluation.lambda_max, evaluation.unit));
  };
  explorer.on("evaluation", update);
  return h("section", { class: "block", "aria-label": "Modes" }, h("h2", {}, "What moves in the softest and the stiffest motion"), h("div", { class: "modes" }, soft, stiff));
}

function content(name: ModeChoice, model: Description, mode: Mode | null | undefined, lambda: number | null | undefined, unit = ""): Node[] {
  const title = h("h3", {}, h("span", { class: "key", "aria-hidden": "true" }), lambda === null || lambda === undefined ? name : `${name}, λ = ${shown(lambda, 4)} ${unit}`);
  if (!mode) return [title, h("p", { class: "soft" }, "none")];
  const order = mode.share.map((share, row) => ({ share, row })).sort((a, b) => b.share - a.share);
  const main = order.slice(0, SHOWN).filter(({ share }, k) => share >= LEAST || k === 0);
  const rest = order.slice(main.length).reduce((sum, { share }) => sum + share, 0);
  const items = main.map(({ share, row }) => {
    const dof = model.dofs[model.rows[row] ?? -1]?.name ?? `${row}`;
    const bar = h("span", { class: "bar", "aria-hidden": "true" });
    bar.style.width = `${100 * share}%`;
    const sign = (mode.vector[row] ?? 0) < 0 ? "−" : "+";
    return h("li", {}, h("span", { class: "name", title: dof }, dof), h("span", {}, sign), h("span", { class: "share" }, `${(100 * share).toFixed(1)}%`), bar);
  });
  const more = order.length - main.length;
  return [title, h("ol", {}, ...items), ...(rest >= LEAST ? [h("p", { class: "small soft" }, `and ${more} more, ${(100 * rest).toFixed(1)}%`)] : [])];
}
