/** The state in the address bar, and back from it. */

import type { Explorer } from "../explorer";
import { fromLink, toLink } from "./link";

/** Browsers refuse a page that writes its address too often. */
const REST = 250;

export function followAddress(explorer: Explorer): void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let written = location.hash.slice(1);
  const write = async () => {
    const { hash } = await toLink(explorer.state);
    if (hash === written) return;
    written = hash;
    history.replaceState(null, "", hash ? `#${hash}` : location.pathname);
  };
  explorer.on(["model", "posture", "view", "tab", "ends", "map", "figure"], () => {
    clearTimeout(timer);
    timer = setTimeout(() => void write(), REST);
  });
  // A link that is pasted over another one.
  addEventListener("hashchange", () => {
    if (location.hash.slice(1) !== written) location.reload();
  });
}

export { fromLink };
