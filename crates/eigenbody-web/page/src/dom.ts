/** Elements in one expression. Words become text, never HTML. */

type Child = Node | string | number | null | undefined | false;

export interface Attributes {
  [name: string]: unknown;
  on?: Record<string, (event: never) => void>;
}

const SVG = "http://www.w3.org/2000/svg";

function dress<E extends Element>(element: E, attributes: Attributes, children: Child[]): E {
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "on") {
      for (const [event, listener] of Object.entries(value as object)) element.addEventListener(event, listener as EventListener);
    } else if (value === true) {
      element.setAttribute(name, "");
    } else if (value !== false && value !== null && value !== undefined) {
      element.setAttribute(name, String(value));
    }
  }
  element.append(...children.filter((child) => child !== null && child !== undefined && child !== false).map((child) => (child instanceof Node ? child : String(child))));
  return element;
}

export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  return dress(document.createElement(tag), attributes, children);
}

export function svg<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  return dress(document.createElementNS(SVG, tag) as SVGElementTagNameMap[K], attributes, children);
}

/** Puts words in an element that does not have them already: what stays is not laid out anew. */
export function write(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** A button of words. */
export function button(label: string, press: () => void, attributes: Attributes = {}): HTMLButtonElement {
  return h("button", { type: "button", ...attributes, on: { click: press } }, label);
}

/** A check box with its label. */
export function checkbox(label: string, checked: boolean, change: (checked: boolean) => void, attributes: Attributes = {}): HTMLLabelElement {
  const box = h("input", { type: "checkbox", ...attributes, on: { change: () => change(box.checked) } });
  box.checked = checked;
  return h("label", { class: "check" }, box, label);
}

export interface Choice {
  value: string;
  label: string;
}

/** A list to choose from, with its label. */
export function select(label: string, choices: Choice[], value: string, change: (value: string) => void): HTMLLabelElement {
  const list = h("select", { on: { change: () => change(list.value) } }, ...choices.map((one) => h("option", { value: one.value }, one.label)));
  list.value = value;
  return h("label", { class: "field" }, h("span", {}, label), list);
}

let last = 0;

/** An identifier that no other element has. */
export function fresh(prefix: string): string {
  return `${prefix}-${++last}`;
}
