/** κ, κ′, λmin, λmax: always in sight. */

import { h, write } from "../dom";
import type { Explorer } from "../explorer";
import { estimate, shown } from "../math/number";

/** Decimal digits of a solve that a precision keeps (as the command line counts them). */
export function digitsLeft(precision: number, weighted: number): number {
  return Math.max(0, Math.floor(precision - Math.log10(weighted)));
}

export function readings(explorer: Explorer): HTMLElement {
  const cell = (name: string, label: string, spoken: string) => {
    const value = h("data", { "data-number": name });
    const unit = h("span", {});
    const more = h("span", { class: "more" });
    const term = h("dt", {}, h("span", { "aria-hidden": "true" }, label), h("span", { class: "away" }, spoken), unit);
    return { value, unit, more, element: h("div", {}, term, h("dd", {}, h("span", { class: "big" }, value), more)) };
  };
  const kappa = cell("kappa", "κ", "kappa, condition number");
  const weighted = cell("kappa_weighted", "κ′", "kappa prime, condition number with every joint in units of its own inertia");
  const low = cell("lambda_min", "λmin", "smallest eigenvalue");
  const high = cell("lambda_max", "λmax", "largest eigenvalue");
  const note = h("p", { class: "block small", hidden: true });
  const put = (place: typeof kappa, x: number | null | undefined, nothing: string, unit = "", more = "") => {
    write(place.value, x === null || x === undefined ? nothing : shown(x));
    write(place.unit, unit ? ` (${unit})` : "");
    place.value.setAttribute("value", x === null || x === undefined ? "" : String(x));
    write(place.more, more);
  };
  const update = () => {
    const { evaluation } = explorer;
    if (!evaluation) return;
    const { bracket, kappa_weighted, error_estimate, unit = "" } = evaluation;
    put(kappa, evaluation.kappa, "∞", "", bracket ? `${shown(bracket[0], 3)} to ${shown(bracket[1], 3)}` : "");
    const left = kappa_weighted ? `digits: f64 ${digitsLeft(15.95, kappa_weighted)}, f32 ${digitsLeft(7.22, kappa_weighted)}` : "";
    put(weighted, kappa_weighted, "∞", "", left);
    const error = (x: number | null | undefined) => (x === null || x === undefined ? "" : `± ${estimate(x)} of it`);
    put(low, evaluation.lambda_min, "–", unit, error(error_estimate?.lambda_min));
    put(high, evaluation.lambda_max, "–", unit, error(error_estimate?.lambda_max));
    note.hidden = !evaluation.note;
    note.textContent = evaluation.note ?? "";
  };
  explorer.on("evaluation", update);
  const list = h("dl", { class: "readings" }, kappa.element, weighted.element, low.element, high.element);
  return h("div", { class: "sticky" }, list, note);
}
