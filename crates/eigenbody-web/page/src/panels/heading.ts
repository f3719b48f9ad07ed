/** The robot's name, and what one does with the whole page. */

import { button, h } from "../dom";
import type { Explorer } from "../explorer";
import { toLink } from "../state/link";
import { fileInput } from "./drop";

export function heading(explorer: Explorer): HTMLElement {
  const name = h("h1", {}, "eigenbody");
  const about = h("p", {}, "");
  const said = h("span", { role: "status", class: "small" });
  const copy = button("Copy link", () => void copyLink(explorer, said));
  explorer.on("model", () => {
    const { model, state } = explorer;
    if (!model) return;
    name.textContent = model.name;
    document.title = `${model.name} · eigenbody`;
    const base = model.options.base === "floating" ? (model.options.reduced || model.format === "family" ? "free-floating" : "floating base") : "fixed base";
    const changes = Object.keys(state.edits.armature).length + Object.keys(state.edits.mass).length;
    const bodies = model.bodies.length === 1 ? "1 moving body" : `${model.bodies.length} moving bodies`;
    const dofs = model.nv === 1 ? "1 degree of freedom" : `${model.nv} degrees of freedom`;
    about.textContent = [bodies, dofs, base, ...(changes === 0 ? [] : [changes === 1 ? "1 change" : `${changes} changes`])].join(", ");
  });
  return h("header", {}, h("div", { class: "about" }, name, about), h("div", { class: "row" }, said, fileInput(explorer, "Open a file…"), copy));
}

async function copyLink(explorer: Explorer, said: HTMLElement): Promise<void> {
  const { hash, whole } = await toLink(explorer.state);
  const link = new URL(location.href);
  link.hash = hash;
  const copied = await navigator.clipboard.writeText(link.href).then(() => true, () => false);
  said.textContent = copied ? (whole ? "Link copied." : "Link copied, without the file: it is too long for a link.") : "The link stands in the address bar.";
  setTimeout(() => (said.textContent = ""), 6000);
}
