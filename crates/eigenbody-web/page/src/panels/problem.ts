/** What went wrong, said once and in full. */

import { button, h } from "../dom";
import type { Explorer } from "../explorer";

export function problem(explorer: Explorer): HTMLElement {
  const text = h("div", {});
  const box = h("div", { class: "problem", hidden: true }, text, button("Close", () => explorer.fail(null)));
  explorer.on("problem", () => {
    const { failure } = explorer;
    box.hidden = failure === null;
    if (!failure) return;
    const { message, excerpt } = failure.problem;
    text.replaceChildren(h("p", {}, h("strong", {}, "Error: "), message), ...(excerpt ? [h("pre", { tabindex: 0, "aria-label": "The place in the file" }, excerpt)] : []));
  });
  return h("div", { role: "alert" }, box);
}
