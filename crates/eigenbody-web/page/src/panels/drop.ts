/** Files from the reader's disk: dropped on the page, or chosen. */

import { h } from "../dom";
import type { Explorer } from "../explorer";

/** Shows a file's robot, or what is wrong with it. */
export async function openFile(explorer: Explorer, file: File): Promise<void> {
  const { text: most } = explorer.start.limits;
  if (file.size > most) {
    explorer.fail(new Error(`${file.name} has ${file.size} bytes, expected at most ${most}`));
    return;
  }
  const source = { name: file.name, text: await file.text() };
  await explorer.open(source);
  explorer.update({ tab: "file" }, "tab");
}

export function fileInput(explorer: Explorer, label: string): HTMLElement {
  const input = h("input", { type: "file", class: "away", accept: ".urdf,.xml,.mjcf,.sdf,.xacro", on: {
    change: () => {
      const [file] = input.files ?? [];
      if (file) void openFile(explorer, file);
      input.value = "";
    },
  } });
  return h("label", { class: "file" }, label, input);
}

export function listenForDrops(explorer: Explorer): void {
  const { body } = document;
  const carries = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  body.addEventListener("dragover", (event) => {
    if (!carries(event)) return;
    event.preventDefault();
    body.classList.add("dropping");
  });
  body.addEventListener("dragleave", (event) => event.relatedTarget === null && body.classList.remove("dropping"));
  body.addEventListener("drop", (event) => {
    body.classList.remove("dropping");
    const [file] = event.dataTransfer?.files ?? [];
    if (!file) return;
    event.preventDefault();
    void openFile(explorer, file);
  });
}
