/** Which robot: a family with its parameters, a built-in one, a file; and how it is read. */

import { button, checkbox, fresh, h, select } from "../dom";
import type { FamilyAbout, Options, Source } from "../api/types";
import type { Explorer } from "../explorer";
import { power } from "../chart/scale";
import { shown, typed } from "../math/number";
import { Latest } from "../state/latest";
import { fileInput } from "./drop";

export function models(explorer: Explorer): HTMLElement {
  return h("div", {}, families(explorer), builtins(explorer), files(explorer), reading(explorer));
}

/** `hydra(40,1,0,1)` as a name and numbers; none if its arguments are not plain numbers in order. */
export function parseFamily(text: string): { name: string; values: number[] } | null {
  const found = /^\s*([a-z_]+)\s*\(([^()]*)\)\s*$/.exec(text);
  const values = found?.[2]!.split(",").map((word) => typed(word.replace(/^\s*[A-Za-zα-ω]+\s*=/, "")));
  return found && values?.every((x) => x !== null) ? { name: found[1]!, values } : null;
}

function families(explorer: Explorer): HTMLElement {
  const { families: all } = explorer.start;
  const box = h("div", { class: "parameters" });
  const text = h("input", { type: "text", id: fresh("family"), size: 24, spellcheck: "false", on: {
    change: () => open(text.value), keydown: (event: KeyboardEvent) => event.key === "Enter" && open(text.value),
  } });
  let family: FamilyAbout | undefined = all[0];
  let values: number[] = family?.parameters.map((one) => one.default) ?? [];

  // While a slider moves, the newest family is the next to be opened.
  const opened = new Latest(
    (word: string) => explorer.open({ family: word }, explorer.state.options, undefined, {}),
    () => {},
    (error) => explorer.fail(error),
  );
  const open = (word: string) => word.trim() && opened.put(word.trim());
  const word = () => `${family?.name ?? ""}(${values.map((x) => String(Number(x.toPrecision(12)))).join(",")})`;
  const build = () => {
    box.replaceChildren(...(family?.parameters ?? []).flatMap((one, k) => {
      const id = fresh("parameter");
      const wide = one.min > 0 && one.max / one.min > 50;
      const slider = h("input", {
        type: "range", id, min: wide ? Math.log(one.min) : one.min, max: wide ? Math.log(one.max) : one.max, step: wide ? "any" : one.step,
        on: { input: () => put(wide ? Math.exp(Number(slider.value)) : Number(slider.value)) },
      });
      const number = h("input", { type: "text", "aria-label": `${one.label}${one.unit ? ` (${one.unit})` : ""}`, inputmode: "decimal", spellcheck: "false", on: { change: () => {
        const x = typed(number.value);
        if (x !== null) put(x);
      } } });
      const show = () => {
        const x = values[k] ?? one.default;
        slider.value = String(wide ? Math.log(x) : x);
        slider.setAttribute("aria-valuetext", `${shown(x, 4)} ${one.unit}`);
        number.value = one.integer ? String(x) : String(Number(x.toPrecision(6)));
      };
      const put = (x: number) => {
        values = values.with(k, one.integer ? Math.round(x) : x);
        show();
        text.value = word();
        open(text.value);
      };
      show();
      return [h("label", { for: id }, `${one.name}, ${one.label}${one.unit ? ` (${one.unit})` : ""}`), slider, number];
    }));
  };
  const choose = select("Family", all.map(({ name, usage }) => ({ value: name, label: usage })), family?.name ?? "", (name) => {
    family = all.find((one) => one.name === name);
    values = family?.parameters.map((one) => one.default) ?? [];
    build();
    text.value = word();
    open(text.value);
  });
  explorer.on("model", () => {
    const source = explorer.source;
    if (!("family" in source)) return;
    if (document.activeElement !== text) text.value = source.family;
    const parsed = parseFamily(source.family);
    const known = all.find((one) => one.name === parsed?.name);
    // Sliders that are being moved are not built anew.
    if (!parsed || !known || box.contains(document.activeElement) || known.parameters.length !== parsed.values.length) return;
    family = known;
    values = parsed.values;
    const list = choose.querySelector("select");
    if (list) list.value = known.name;
    build();
  });
  build();
  text.value = word();
  return h("section", { class: "block", "aria-label": "Families" }, h("h2", {}, "A family"), choose, box,
    h("div", { class: "row" }, h("span", { class: "field" }, h("label", { for: text.id }, "or typed"), text), button("Open", () => open(text.value), { "aria-label": "Open this family" })));
}

function builtins(explorer: Explorer): HTMLElement {
  const list = explorer.start.builtins.map(({ name, title }) => button(title, () => void explorer.open({ builtin: name }), { "data-builtin": name }));
  const first: Source = explorer.start.source;
  if ("opened" in first) list.unshift(button("The file given on the command line", () => void explorer.open(null, explorer.start.options)));
  return h("section", { class: "block", "aria-label": "Built-in robots" }, h("h2", {}, "A built-in robot"), h("div", { class: "row" }, ...list));
}

function files(explorer: Explorer): HTMLElement {
  return h("section", { class: "block", "aria-label": "Robot file" }, h("h2", {}, "A file of yours"),
    h("div", { class: "drop row" }, fileInput(explorer, "Choose a file…"), h("span", { class: "soft" }, "or drop a URDF, MJCF or SDF anywhere on this page. It goes to the server on this machine and nowhere else.")));
}

function reading(explorer: Explorer): HTMLElement {
  const box = h("div", { class: "row" });
  const size = h("p", { class: "small soft" });
  explorer.on("model", () => {
    const { model } = explorer;
    if (!model) return;
    const { can, options } = model;
    const again = (change: Partial<Options>) => void explorer.open(explorer.state.source, { ...options, ...change }, explorer.state.edits);
    const bases = [{ value: "fixed", label: "fixed" }, { value: "floating", label: "floating" }];
    box.replaceChildren(
      ...(can.float ? [select("Base", bases, options.base, (base) => again({ base: base === "floating" ? "floating" : "fixed", reduced: false }))] : []),
      ...(can.float && options.base === "floating" && model.format !== "family" ? [checkbox("base removed (H*)", options.reduced, (reduced) => again({ reduced }))] : []),
      ...(can.mimic ? [checkbox("mimic joints follow", options.mimic, (mimic) => again({ mimic }))] : []),
      ...(can.rotors ? [checkbox("rotors of the file", options.rotors, (rotors) => again({ rotors }))] : []));
    const length = shown(model.extent, 3);
    size.textContent = `${model.bodies.length} moving bodies, ${model.nv} degrees of freedom, ${shown(model.mass, 4)} kg, reaches ${model.extent >= 1e4 ? power(model.extent) : length} m`;
  });
  return h("section", { class: "block", "aria-label": "How it is read" }, h("h2", {}, "How it is read"), box, size);
}
