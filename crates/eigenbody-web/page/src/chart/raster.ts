/** A grid of coloured squares with a cursor: by pointer, or by arrow keys. */

import { h } from "../dom";
import { css, cividis, type Rgb } from "../math/colour";

export interface Grid {
  label: string;
  columns: number;
  rows: number;
  /** From 0 to 1; none for what has no number. */
  value(row: number, column: number): number | null;
  /** What the line below says of a square. */
  say(row: number, column: number): string;
  /** What a press or Enter does. */
  press?: (row: number, column: number) => void;
  /** A square to be marked. */
  mark?: { row: number; column: number } | null;
  /** Row 0 at the bottom, as for y. */
  upward?: boolean;
}

export class Raster {
  private readonly canvas = h("canvas", {});
  private readonly cursor = h("div", { class: "raster-cursor", hidden: true });
  private readonly marked = h("div", { class: "raster-mark", hidden: true });
  private readonly readout = h("p", { class: "readout" });
  private readonly box: HTMLElement;
  readonly element: HTMLElement;
  private grid: Grid | null = null;
  private at = { row: 0, column: 0 };

  constructor(private readonly hint: string) {
    this.box = h("div", { class: "raster-box", tabindex: 0, role: "application", "aria-roledescription": "map of squares" }, this.canvas, this.marked, this.cursor);
    this.readout.textContent = hint;
    this.element = h("div", { class: "raster" }, this.box, this.readout);
    this.box.addEventListener("pointermove", (event) => this.point(event));
    this.box.addEventListener("pointerleave", () => this.leave());
    this.box.addEventListener("click", (event) => {
      this.point(event);
      this.grid?.press?.(this.at.row, this.at.column);
    });
    this.box.addEventListener("keydown", (event) => this.key(event));
    this.box.addEventListener("blur", () => this.leave());
  }

  show(grid: Grid): void {
    this.grid = grid;
    const { columns, rows } = grid;
    this.box.setAttribute("aria-label", `${grid.label}. Arrow keys go from square to square${grid.press ? ", Enter goes there" : ""}.`);
    [this.canvas.width, this.canvas.height] = [columns, rows];
    this.box.style.aspectRatio = `${columns} / ${rows}`;
    const pen = this.canvas.getContext("2d");
    if (!pen) return;
    const picture = pen.createImageData(columns, rows);
    for (let row = 0; row < rows; row++) {
      for (let column = 0; column < columns; column++) {
        const value = grid.value(row, column);
        const start = 4 * ((grid.upward ? rows - 1 - row : row) * columns + column);
        if (value !== null) picture.data.set([...cividis(value), 255], start);
      }
    }
    pen.putImageData(picture, 0, 0);
    this.put(this.marked, grid.mark ?? null);
    this.at = { row: Math.min(this.at.row, rows - 1), column: Math.min(this.at.column, columns - 1) };
    if (!this.cursor.hidden) this.say();
  }

  private put(element: HTMLElement, square: { row: number; column: number } | null): void {
    element.hidden = square === null || !this.grid;
    if (!square || !this.grid) return;
    const { rows, columns, upward } = this.grid;
    const row = upward ? rows - 1 - square.row : square.row;
    element.style.left = `${(100 * square.column) / columns}%`;
    element.style.top = `${(100 * row) / rows}%`;
    element.style.width = `${100 / columns}%`;
    element.style.height = `${100 / rows}%`;
  }

  private say(): void {
    this.put(this.cursor, this.at);
    this.readout.textContent = this.grid?.say(this.at.row, this.at.column) ?? "";
  }

  private leave(): void {
    this.cursor.hidden = true;
    this.readout.textContent = this.hint;
  }

  private point(event: MouseEvent): void {
    if (!this.grid) return;
    const box = this.box.getBoundingClientRect();
    const { rows, columns, upward } = this.grid;
    const place = (part: number, count: number) => Math.min(count - 1, Math.max(0, Math.floor(part * count)));
    const row = place((event.clientY - box.top) / box.height, rows);
    this.at = { row: upward ? rows - 1 - row : row, column: place((event.clientX - box.left) / box.width, columns) };
    this.say();
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowUp: [-1, 0], ArrowDown: [1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] }[event.key];
    if (!this.grid) return;
    if (step) {
      const { rows, columns, upward } = this.grid;
      const row = this.at.row + (upward ? -1 : 1) * step[0]!;
      this.at = { row: Math.min(rows - 1, Math.max(0, row)), column: Math.min(columns - 1, Math.max(0, this.at.column + step[1]!)) };
      this.say();
    } else if (event.key === "Enter") {
      this.grid.press?.(this.at.row, this.at.column);
    } else {
      return;
    }
    event.preventDefault();
  }
}

/** The scale from its low to its high end, in words and colours. */
export function colourBar(low: string, high: string): HTMLElement {
  const steps: Rgb[] = Array.from({ length: 24 }, (_, k) => cividis(k / 23));
  const bar = h("span", { class: "colour-bar", "aria-hidden": "true" }, ...steps.map((colour) => {
    const step = h("span");
    step.style.background = css(colour);
    return step;
  }));
  return h("p", { class: "colour-scale" }, h("span", {}, low), bar, h("span", {}, high));
}
