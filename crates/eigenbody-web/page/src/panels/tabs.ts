/** Tabs by the ARIA pattern: one Tab stop, arrow keys between them. */

import { h } from "../dom";
import type { Explorer } from "../explorer";
import { TABS, type Tab } from "../state/state";

const NAMES: Record<Tab, string> = { analysis: "Analysis", line: "Line and map", model: "Robot", file: "File and changes", figures: "Figures" };

export function tabs(explorer: Explorer, panels: Record<Tab, HTMLElement[]>): HTMLElement {
  const buttons = TABS.map((tab) => h("button", { type: "button", role: "tab", id: `tab-${tab}`, "aria-controls": `panel-${tab}`, on: { click: () => choose(tab) } }, NAMES[tab]));
  const boxes = TABS.map((tab) => h("div", { role: "tabpanel", id: `panel-${tab}`, "aria-labelledby": `tab-${tab}` }, ...panels[tab]));
  const choose = (tab: Tab) => {
    if (tab === explorer.state.tab) return;
    explorer.update({ tab }, "tab");
    explorer.ask();
  };
  const update = () => {
    TABS.forEach((tab, k) => {
      const chosen = tab === explorer.state.tab;
      buttons[k]!.setAttribute("aria-selected", String(chosen));
      buttons[k]!.tabIndex = chosen ? 0 : -1;
      boxes[k]!.hidden = !chosen;
    });
  };
  const bar = h("div", { role: "tablist", "aria-label": "About the robot", on: {
    keydown: (event: KeyboardEvent) => {
      const at = TABS.indexOf(explorer.state.tab);
      const next = { ArrowRight: at + 1, ArrowLeft: at - 1 + TABS.length, Home: 0, End: TABS.length - 1 }[event.key];
      const tab = next === undefined ? undefined : TABS[next % TABS.length];
      if (!tab) return;
      event.preventDefault();
      choose(tab);
      buttons[TABS.indexOf(tab)]!.focus();
    },
  } }, ...buttons);
  explorer.on("tab", update);
  update();
  return h("div", {}, bar, ...boxes);
}
