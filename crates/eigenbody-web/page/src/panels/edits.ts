/** Armatures and masses to change, and the patch that says so. */

import type { Edits, PatchFormat } from "../api/types";
import { button, h } from "../dom";
import type { Explorer } from "../explorer";
import { typed } from "../math/number";
import { NO_EDITS } from "../state/state";

/** Rows of a table; a robot may have hundreds. */
const MOST = 200;

export function edits(explorer: Explorer): HTMLElement {
  const armature = h("div", { class: "scroll edits", tabindex: 0, role: "region", "aria-label": "Armatures" });
  const mass = h("div", { class: "scroll edits", tabindex: 0, role: "region", "aria-label": "Masses" });
  const reset = button("Undo all changes", () => void explorer.edit(NO_EDITS));
  const why = h("p", { class: "small soft" });
  const saves = (["urdf", "mjcf"] as const).map((format) => ({ format, button: button(`Save as ${format.toUpperCase()}`, () => void save(explorer, format, why)) }));

  const change = (kind: keyof Edits, name: string, text: string, input: HTMLInputElement) => {
    const x = typed(text);
    input.setAttribute("aria-invalid", String(x === null));
    if (x === null) return;
    const { edits: now } = explorer.state;
    void explorer.edit({ ...now, [kind]: { ...now[kind], [name]: x } });
  };
  const table = (kind: keyof Edits, caption: string, rows: { name: string; value: number; unit: string }[]) =>
    h("table", {}, h("caption", {}, caption), h("tbody", {}, ...rows.slice(0, MOST).map(({ name, value, unit }) => {
      const changed = name in explorer.state.edits[kind];
      const input = h("input", { type: "text", inputmode: "decimal", spellcheck: "false", "aria-label": `${name} (${unit})`, "data-edit": `${kind}:${name}`, on: {
        change: () => change(kind, name, input.value, input),
      } });
      input.value = String(Number(value.toPrecision(8)));
      return h("tr", { class: changed ? "changed" : null }, h("th", { scope: "row" }, name, changed && h("span", { class: "away" }, " (changed)")), h("td", {}, input), h("td", {}, unit));
    })), rows.length > MOST && h("tfoot", {}, h("tr", {}, h("td", { colspan: 3 }, `and ${rows.length - MOST} more`))));
  explorer.on("model", () => {
    const { model, state } = explorer;
    if (!model) return;
    const focused = document.activeElement?.getAttribute("data-edit");
    armature.replaceChildren(table("armature", "Armature: inertia of a motor's rotor, seen at the joint", model.dofs.map(({ name, armature: value, slides }) => ({ name, value, unit: slides ? "kg" : "kg m²" }))));
    mass.replaceChildren(table("mass", "Mass of a link; its inertia grows with it", model.bodies.map(({ link, mass: value }) => ({ name: link, value, unit: "kg" }))));
    if (focused) document.querySelector<HTMLElement>(`[data-edit="${CSS.escape(focused)}"]`)?.focus();
    reset.disabled = Object.keys({ ...state.edits.armature, ...state.edits.mass }).length === 0;
    for (const { format, button: one } of saves) one.disabled = !model.patch[format];
    why.textContent = saves.flatMap(({ format }) => (model.patch[format] ? [] : [`No ${format.toUpperCase()}: ${model.patch.why[format] ?? "it cannot say what the model is"}.`])).join(" ");
  });
  return h("section", { class: "block", "aria-label": "Changes" }, h("h2", {}, "Change it, and watch κ"),
    h("div", { class: "modes" }, armature, mass), h("div", { class: "row" }, reset, ...saves.map((one) => one.button)), why);
}

async function save(explorer: Explorer, format: PatchFormat, why: HTMLElement): Promise<void> {
  await explorer.attempt(async () => {
    if (!explorer.model) return;
    const patch = await explorer.client.patch(explorer.model.id, format);
    const link = h("a", { href: URL.createObjectURL(new Blob([patch.text], { type: "application/xml" })), download: patch.name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
    why.textContent = `${patch.name} was saved.${patch.note ? ` ${patch.note}` : ""}`;
  });
}
