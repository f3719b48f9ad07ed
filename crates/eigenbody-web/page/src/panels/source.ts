/** The robot file's text, with what was found at its lines. */

import type { CheckFinding, Finding } from "../api/types";
import { button, h } from "../dom";
import type { Explorer } from "../explorer";

export interface Note {
  level: "error" | "warning" | "note";
  line: number | null;
  text: string;
  advice?: string;
  /** Where it holds. */
  q?: number[];
}

/** Most lines that are laid out; a longer file is shown around its notes. */
const MOST = 3000;
const AROUND = 20;

export function source(explorer: Explorer, checked: () => CheckFinding[]): { element: HTMLElement; update(): void } {
  const heading = h("h2", {}, "Findings");
  const list = h("ul", { class: "findings" });
  const listing = h("div", { class: "text mono", tabindex: 0, role: "region", "aria-label": "Text of the robot file", hidden: true });

  const update = () => {
    const { failure, model } = explorer;
    const failed = failure?.source ?? null;
    const text = failed && "text" in failed ? failed.text : failed ? null : modelText(explorer);
    const notes: Note[] = failed && failure
      ? [{ level: "error", line: failure.problem.line ?? null, text: failure.problem.what ?? failure.problem.message }]
      : [...(model?.findings ?? []).map(ofModel), ...checked().map(ofCheck)];
    const name = failed && "text" in failed ? failed.name : (model?.name ?? "");
    heading.textContent = failed ? `${name} gives no robot` : `Findings on ${name}`;
    const clean = h("li", { class: "clean" }, "Nothing suspicious in the file.");
    list.replaceChildren(...(notes.length === 0 ? [clean] : notes.map((note) => item(note, name, explorer, text !== null, (line) => show(line)))));
    listing.hidden = text === null;
    listing.replaceChildren(...(text === null ? [] : [lines(text, notes)]));
    const first = notes.find(({ line }) => line !== null)?.line;
    if (first) show(first);
  };
  const show = (line: number) => {
    const target = listing.querySelector<HTMLElement>(`[data-line="${line}"]`);
    if (target) listing.scrollTop = target.offsetTop - listing.offsetTop - listing.clientHeight / 3;
  };
  explorer.on(["model", "problem"], update);
  explorer.on("tab", () => explorer.state.tab === "file" && update());
  return { element: h("section", { class: "block", "aria-label": "Findings" }, heading, list, listing), update };
}

function modelText({ source: given, model }: Explorer): string | null {
  return "text" in given ? given.text : (model?.text ?? null);
}

function ofModel({ message, subject, place }: Finding): Note {
  const text = subject && !message.includes(subject) ? `${subject}: ${message}` : message;
  return { level: "warning", line: place?.line ?? null, text };
}

function ofCheck({ severity, message, advice, place, q }: CheckFinding): Note {
  return { level: severity, line: place?.line ?? null, text: message, advice, q };
}

function item(note: Note, file: string, explorer: Explorer, shownText: boolean, show: (line: number) => void): HTMLLIElement {
  const { line, text, advice, level, q } = note;
  return h("li", { class: level },
    h("strong", {}, level), " ", line === null ? "" : `${file}:${line}: `, text, advice ? ` ${advice}` : "",
    line !== null && shownText && button("Show", () => show(line), { "aria-label": `Show line ${line}` }),
    q !== undefined && q.length > 0 && button("Go there", () => explorer.pose(q)));
}

function lines(text: string, notes: readonly Note[]): HTMLOListElement {
  const all = text.split(/\r\n|\r|\n/);
  const noted = new Map<number, Note[]>();
  for (const note of notes) if (note.line !== null) noted.set(note.line, [...(noted.get(note.line) ?? []), note]);
  const near = (no: number) => [...noted.keys()].some((line) => Math.abs(line - no) <= AROUND);
  const list = h("ol", {});
  let left = false;
  all.forEach((words, k) => {
    const no = k + 1;
    if (all.length > MOST && no > AROUND && !near(no)) {
      if (!left) list.append(h("li", {}, h("span", { class: "no" }, "…"), h("code", {})));
      left = true;
      return;
    }
    left = false;
    const here = noted.get(no) ?? [];
    list.append(h("li", { class: here.length > 0 ? "at" : null, "data-line": no },
      h("span", { class: "no" }, no), h("code", {}, words || " "),
      ...here.map(({ level, text: message }) => h("div", { class: `note ${level}` }, h("strong", {}, level), ` ${message}`))));
  });
  return list;
}
