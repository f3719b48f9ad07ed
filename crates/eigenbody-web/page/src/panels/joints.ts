/** Sliders, one for every number that moves the robot. */

import { button, fresh, h } from "../dom";
import type { Explorer } from "../explorer";
import { shown, typed } from "../math/number";
import { handles, type Handle } from "./coordinates";

/** Sliders at a time; a robot may have hundreds. */
const PAGE = 60;

interface Row {
  handle: Handle;
  label: HTMLLabelElement;
  slider: HTMLInputElement;
  box: HTMLInputElement;
  parts: HTMLElement[];
  /** The number that it shows. */
  at: number;
}

export function joints(explorer: Explorer): HTMLElement {
  const filter = h("input", { type: "text", id: fresh("filter"), placeholder: "name", size: 12, on: { input: () => build() } });
  const find = h("div", { class: "field" }, h("label", { for: filter.id }, "Find"), filter);
  const list = h("div", { class: "joints" });
  const count = h("p", { class: "small soft" });
  const more = button("Show more", () => {
    limit += 5 * PAGE;
    build();
  });
  let limit = PAGE;
  let all: Handle[] = [];
  let rows: Row[] = [];

  const build = () => {
    const wanted = filter.value.trim().toLowerCase();
    const found = all.filter(({ label }) => label.toLowerCase().includes(wanted));
    rows = found.slice(0, limit).map((handle) => row(handle, explorer));
    list.replaceChildren(...rows.flatMap(({ parts }) => parts));
    find.hidden = all.length <= 12;
    more.hidden = found.length <= limit;
    count.hidden = found.length <= rows.length && wanted === "";
    count.textContent = `${rows.length} of ${all.length} shown`;
    update();
    light();
  };
  const update = () => {
    const q = explorer.q;
    const placed = explorer.evaluation?.q ?? q;
    for (const row of rows) {
      const { handle, slider, box } = row;
      const x = handle.get(slider.disabled ? placed : q);
      if (Object.is(x, row.at)) continue;
      row.at = x;
      // What is being typed is not written over.
      if (document.activeElement !== box) box.value = shown(x, 5);
      slider.value = String(x);
      slider.setAttribute("aria-valuetext", `${shown(x, 4)} ${handle.unit}`);
    }
  };
  const light = () => rows.forEach(({ handle, label }) => label.classList.toggle("on", handle.joint === explorer.hovered));
  let built = "";
  explorer.on("model", () => {
    const joints = explorer.model?.joints ?? [];
    // An edited robot has the same sliders: they stay, one may be under a finger.
    const key = JSON.stringify(joints);
    if (key === built) return update();
    built = key;
    filter.value = "";
    limit = PAGE;
    all = joints.flatMap(handles);
    build();
  });
  explorer.on(["posture", "evaluation"], update);
  explorer.on("hover", light);
  const scroller = h("div", { class: "list" }, list, more);
  return h("section", { class: "block", "aria-label": "Joints" }, h("div", { class: "row" }, h("h2", {}, "Joints"), find, count), scroller);
}

function row(handle: Handle, explorer: Explorer): Row {
  const joint = explorer.model?.joints[handle.joint];
  const follows = joint?.follows ?? null;
  const [low, high] = handle.range;
  const id = fresh("joint");
  const lit = () => explorer.hover(handle.joint);
  const dark = () => explorer.hover(null);
  const slider = h("input", {
    type: "range", id, min: low, max: high, step: "any", disabled: follows !== null,
    on: { input: () => explorer.pose(handle.set(explorer.q, Number(slider.value))), focus: lit, blur: dark, pointerenter: lit, pointerleave: dark },
  });
  const box = h("input", {
    type: "text", inputmode: "decimal", disabled: follows !== null, "aria-label": `${handle.label} (${handle.unit})`, spellcheck: "false",
    on: {
      change: () => {
        const x = typed(box.value);
        box.setAttribute("aria-invalid", String(x === null));
        if (x !== null) explorer.pose(handle.set(explorer.q, x));
      },
      blur: () => {
        box.removeAttribute("aria-invalid");
        box.value = shown(handle.get(explorer.q), 5);
      },
    },
  });
  const title = follows === null ? handle.label : `${handle.label}, follows ${follows}`;
  const label = h("label", { for: id, title }, handle.label);
  return { handle, label, slider, box, parts: [label, slider, box, h("span", { class: "unit" }, handle.unit)], at: Number.NaN };
}
