/** What is drawn over the robot, and which mode. */

import { button, checkbox, fresh, h } from "../dom";
import type { Explorer } from "../explorer";
import type { ModeChoice, Overlay } from "../state/state";
import { calm } from "../theme";
import type { Stage } from "../view/stage";

const NAMES: [Overlay, string][] = [
  ["arrows", "arrows"], ["axes", "joint axes"], ["centres", "centres of mass"], ["skeleton", "skeleton"], ["floor", "floor"],
];

export function overlays(explorer: Explorer, stage: Stage): HTMLElement {
  const { state } = explorer;
  const group = fresh("mode");
  const radio = (mode: ModeChoice) => {
    const input = h("input", { type: "radio", name: group, value: mode, on: { change: () => explorer.update({ mode }, "view") } });
    input.checked = state.mode === mode;
    return h("label", { class: `check ${mode}` }, input, h("span", {}, h("span", { class: "key", "aria-hidden": "true" }), `${mode} mode`));
  };
  const swing = button("Swing", () => explorer.update({ swinging: !explorer.state.swinging }, "view"), { "aria-pressed": String(state.swinging) });
  const phase = h("input", { type: "range", id: fresh("phase"), min: 0, max: 1, step: "any", value: 0.5, on: {
    input: () => {
      stage.swing.phase = Math.asin(2 * Number(phase.value) - 1) / (2 * Math.PI);
      stage.draw();
    },
  } });
  // For readers who asked for less motion: they move it.
  const byHand = h("span", { class: "field" }, h("label", { for: phase.id }, "along the mode"), phase);
  const energy = checkbox("same energy for both", state.sameEnergy, (sameEnergy) => explorer.update({ sameEnergy }, "view"));
  const shapes = checkbox("visuals of the file", state.shapes, (on) => explorer.update({ shapes: on }, "view"));
  const update = () => {
    const { swinging } = explorer.state;
    swing.setAttribute("aria-pressed", String(swinging));
    byHand.hidden = !(swinging && calm());
  };
  explorer.on("view", update);
  explorer.on("model", () => {
    shapes.hidden = !explorer.model?.bodies.some((body) => body.shapes.length > 0);
  });
  update();
  const toggles = NAMES.map(([name, label]) =>
    checkbox(label, state.overlays.has(name), (on) => {
      const now = new Set(explorer.state.overlays);
      if (on) now.add(name);
      else now.delete(name);
      explorer.update({ overlays: now }, "view");
    }, { "data-overlay": name }));
  return h("section", { class: "block", "aria-label": "What is drawn" },
    h("div", { class: "row" }, h("span", { class: "row", role: "radiogroup", "aria-label": "Mode" }, radio("softest"), radio("stiffest")), swing, byHand, energy),
    h("div", { class: "row" }, ...toggles, checkbox("colour by share", state.colours, (colours) => explorer.update({ colours }, "view")), shapes));
}
