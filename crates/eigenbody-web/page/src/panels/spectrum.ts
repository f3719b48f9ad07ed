/** All eigenvalues, ascending, on a logarithmic scale. */

import { h } from "../dom";
import type { Explorer } from "../explorer";
import { Plot } from "../chart/plot";
import { shown } from "../math/number";

export function spectrum(explorer: Explorer): HTMLElement {
  const plot = new Plot();
  const text = h("p", { class: "small soft" });
  explorer.on("details", () => {
    const values = explorer.details?.eigenvalues;
    plot.element.hidden = !values;
    text.hidden = Boolean(values);
    text.textContent = "All eigenvalues are computed for up to 1000 degrees of freedom.";
    if (!values) return;
    const unit = explorer.evaluation?.unit;
    const what = `eigenvalue${unit ? ` (${unit})` : ""}`;
    plot.show({
      label: `Spectrum: ${values.length} eigenvalues from ${shown(values[0], 4)} to ${shown(values.at(-1), 4)} ${unit ?? ""}`,
      x: { label: "number, ascending", log: false },
      y: { label: what, log: true },
      curves: [{ name: "eigenvalues", style: 2, line: false, markers: true, points: values.map((y, k) => ({ x: k + 1, y })) }],
      height: 190,
    });
  });
  return h("section", { class: "block", "aria-label": "Spectrum" }, h("h2", {}, "Spectrum"), plot.element, text);
}
