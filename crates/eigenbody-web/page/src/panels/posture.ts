/** Postures by name: zero, zag, curl, random, keyframes, or any that the command line takes. */

import { button, fresh, h, select } from "../dom";
import type { Explorer } from "../explorer";

export function posture(explorer: Explorer): HTMLElement {
  let seed = 0;
  const angle = h("input", { type: "text", id: fresh("angle"), value: "pi/4", size: 6, spellcheck: "false" });
  const config = h("input", { type: "text", id: fresh("config"), size: 16, spellcheck: "false", placeholder: "elbow=pi/2", on: { keydown: (event: KeyboardEvent) => event.key === "Enter" && go() } });
  const go = () => config.value.trim() && void explorer.poseBy(config.value.trim());
  const keyframes = h("span", {});
  explorer.on("model", () => {
    const frames = explorer.model?.keyframes ?? [];
    const choices = [{ value: "", label: "choose" }, ...frames.map(({ name }) => ({ value: name, label: name }))];
    const list = select("Keyframe", choices, "", (name) => {
      const frame = frames.find((one) => one.name === name);
      if (frame) explorer.pose(frame.q);
    });
    keyframes.replaceChildren(...(frames.length > 0 ? [list] : []));
  });
  return h("section", { class: "block row", "aria-label": "Postures" },
    button("Zero", () => void explorer.poseBy("zero")),
    button("Zag", () => void explorer.poseBy(`zag(${angle.value})`)),
    button("Curl", () => void explorer.poseBy(`curl(${angle.value})`)),
    h("span", { class: "field" }, h("label", { for: angle.id }, "by"), angle, "rad"),
    button("Random", () => void explorer.poseBy(`random(${++seed})`)),
    keyframes,
    h("span", { class: "field" }, h("label", { for: config.id }, "At"), config, button("Go", go, { "aria-label": "Go to this configuration" })));
}
