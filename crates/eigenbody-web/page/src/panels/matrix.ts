/** H as a map of magnitudes, or of couplings |H_ij| / √(H_ii H_jj). */

import { h, select } from "../dom";
import type { Explorer } from "../explorer";
import { colourBar, Raster } from "../chart/raster";
import { logPlace } from "../math/colour";
import { power } from "../chart/scale";
import { shown } from "../math/number";

/** Magnitudes are shown over at most so many decades. */
const DECADES = 8;

export function matrix(explorer: Explorer): HTMLElement {
  const raster = new Raster("Point at a square, or use arrow keys.");
  const scale = h("div", {});
  const text = h("p", { class: "small soft" });
  let kind = "magnitude";
  const choice = select("Show", [{ value: "magnitude", label: "|H| (log)" }, { value: "coupling", label: "coupling" }], kind, (value) => {
    kind = value;
    update();
  });
  const update = () => {
    const { model, details } = explorer;
    const picture = details?.matrix;
    raster.element.hidden = scale.hidden = !picture;
    text.hidden = Boolean(picture);
    text.textContent = "The matrix is formed for up to 1000 degrees of freedom.";
    if (!picture || !model) return;
    const { size, pooled, values } = picture;
    choice.hidden = pooled > 1;
    const at = (row: number, column: number) => values[row * size + column] ?? 0;
    const largest = values.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
    const least = values.reduce((low, x) => (x === 0 ? low : Math.min(low, Math.abs(x))), largest);
    const low = Math.max(least, largest * 10 ** -DECADES);
    const coupled = kind === "coupling" && pooled === 1;
    const coupling = (row: number, column: number) => Math.abs(at(row, column)) / Math.sqrt(at(row, row) * at(column, column));
    const name = (k: number) => {
      const last = Math.min((k + 1) * pooled, model.rows.length) - 1;
      const dof = (row: number) => model.dofs[model.rows[row] ?? -1]?.name ?? String(row);
      return pooled === 1 ? dof(k) : `${dof(k * pooled)} to ${dof(last)}`;
    };
    const unit = (row: number, column: number) => {
      const slides = [row, column].filter((k) => model.dofs[model.rows[k] ?? -1]?.slides).length;
      return pooled > 1 ? "" : (["kg m²", "kg m", "kg"][slides] ?? "");
    };
    scale.replaceChildren(coupled ? colourBar("0", "1") : colourBar(power(low), `${power(largest)}${model.unit ? ` ${model.unit}` : ""}`));
    raster.show({
      label: `Matrix H, ${picture.rows} by ${picture.rows}`,
      rows: size,
      columns: size,
      value: (row, column) => {
        const x = Math.abs(at(row, column));
        if (x === 0) return null;
        return coupled ? coupling(row, column) : logPlace(Math.max(x, low), low, largest);
      },
      say: (row, column) => {
        const entry = `${shown(at(row, column), 4)} ${unit(row, column)}`.trim();
        const where = row === column ? name(row) : `${name(row)} × ${name(column)}`;
        return `${where}: ${pooled > 1 ? "largest " : ""}${entry}${coupled && row !== column ? `, coupling ${shown(coupling(row, column), 3)}` : ""}`;
      },
    });
  };
  explorer.on("details", update);
  return h("section", { class: "block", "aria-label": "Matrix" }, h("div", { class: "row" }, h("h2", {}, "Matrix H"), choice), raster.element, scale, text);
}
