/** All that a link to the page holds. */

import type { Edits, Options, Source } from "../api/types";

export const TABS = ["analysis", "line", "model", "file", "figures"] as const;
export type Tab = (typeof TABS)[number];

export const OVERLAYS = ["axes", "centres", "skeleton", "arrows", "floor"] as const;
export type Overlay = (typeof OVERLAYS)[number];

export type ModeChoice = "softest" | "stiffest";

/** Where the camera stands: two angles (rad), distance and target (m). Distance 0: wherever the whole robot is seen. */
export interface EyeState {
  azimuth: number;
  elevation: number;
  distance: number;
  target: [number, number, number];
}

/** As a link has it: five digits. What is seen is then what a link shows. */
export function rounded({ azimuth, elevation, distance, target }: EyeState): EyeState {
  const five = (x: number) => Number(x.toPrecision(5));
  return { azimuth: five(azimuth), elevation: five(elevation), distance: five(distance), target: [five(target[0]), five(target[1]), five(target[2])] };
}

export interface State {
  /** What is shown; none is what the server was started with. */
  source: Source | null;
  options: Partial<Options>;
  edits: Edits;
  /** The configuration; none is the model's own. */
  q: number[] | null;
  metric: string;
  tab: Tab;
  overlays: ReadonlySet<Overlay>;
  /** The mode that arrows, colours and motion are about. */
  mode: ModeChoice;
  colours: boolean;
  shapes: boolean;
  swinging: boolean;
  /** Both modes with the energy that the softest has, instead of the same swing. */
  sameEnergy: boolean;
  eye: EyeState;
  /** The ends of the line. */
  a: number[] | null;
  b: number[] | null;
  /** The joints of the map, by name. */
  map: [string, string] | null;
  figure: string | null;
}

export const NO_EDITS: Edits = { armature: {}, mass: {} };

export const FIRST: State = {
  source: null,
  options: {},
  edits: NO_EDITS,
  q: null,
  metric: "euclidean",
  tab: "analysis",
  overlays: new Set<Overlay>(["axes", "skeleton", "arrows", "floor"]),
  mode: "softest",
  colours: false,
  shapes: true,
  swinging: false,
  sameEnergy: false,
  eye: { azimuth: 0.6, elevation: 0.3, distance: 0, target: [0, 0, 0] },
  a: null,
  b: null,
  map: null,
  figure: null,
};
