/** The metric B of H x = λ B x. */

import { fresh, h, select, write } from "../dom";
import type { Explorer } from "../explorer";

export function metric(explorer: Explorer): HTMLElement {
  const use = (text: string) => {
    explorer.update({ metric: text }, "view");
    explorer.ask();
  };
  const [kind, value = ""] = explorer.state.metric.split("=");
  const length = h("input", { type: "text", id: fresh("length"), size: 5, value: value || "0.3", spellcheck: "false", on: { change: () => use(`length=${length.value}`) } });
  const box = h("span", { class: "field", hidden: kind !== "length" }, h("label", { for: length.id }, "1 rad ="), length, "m");
  const choices = [
    { value: "euclidean", label: "euclidean: 1 rad = 1 m" },
    { value: "unit-diagonal", label: "unit diagonal" },
    { value: "length", label: "length" },
  ];
  const list = select("Metric", choices, kind ?? "euclidean", (name) => {
    box.hidden = name !== "length";
    use(name === "length" ? `length=${length.value}` : name);
  });
  const method = h("span", { class: "small soft" });
  explorer.on("evaluation", () => {
    const { evaluation } = explorer;
    const how = { dense: "dense eigensolver", sturm: "Sturm counts along the tree" }[evaluation?.method ?? ""] ?? "";
    write(method, how ? `by ${how}` : "");
  });
  return h("div", { class: "block row" }, list, box, method);
}
