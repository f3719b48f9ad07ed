/** Colours of the style sheet, for what is drawn on a canvas; anew when the reader's scheme changes. */

import { hex } from "./math/colour";

export interface Theme {
  ink: number;
  soft: number;
  faint: number;
  paper: number;
  blue: number;
  vermilion: number;
  green: number;
  orange: number;
  purple: number;
  sky: number;
  link: number;
  link2: number;
  /** A link without a share. */
  pale: number;
  lit: number;
  dark: boolean;
}

const DARK = "(prefers-color-scheme: dark)";

export function theme(): Theme {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => hex(style.getPropertyValue(`--${name}`));
  return {
    ink: colour("ink"),
    soft: colour("soft"),
    faint: colour("faint"),
    paper: colour("paper"),
    blue: colour("blue"),
    vermilion: colour("vermilion"),
    green: colour("green"),
    orange: colour("orange"),
    purple: colour("purple"),
    sky: colour("sky"),
    link: colour("link"),
    link2: colour("link2"),
    pale: colour("pale"),
    lit: colour("orange"),
    dark: matchMedia(DARK).matches,
  };
}

export function onThemeChange(listener: () => void): void {
  matchMedia(DARK).addEventListener("change", listener);
}

/** Whether the reader asked for less motion. */
export function calm(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

export function cssColour(colour: number): string {
  return `#${colour.toString(16).padStart(6, "0")}`;
}
