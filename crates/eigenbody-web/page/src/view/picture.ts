/** What is to be seen, before anyone draws it: places, colours, axes, arrows. */

import { Vector3, type PerspectiveCamera } from "three";
import type { Description, Evaluation, Pose } from "../api/types";
import { mixed } from "../math/colour";
import type { Overlay, State } from "../state/state";
import type { Theme } from "../theme";
import { placed, turned, unturned, within } from "./frames";

/** A DoF in the world. */
export interface Axis {
  origin: Vector3;
  direction: Vector3;
  slides: boolean;
}

/** How a mode moves a DoF: from −1 to 1, the largest ±1. */
export interface Arrow extends Axis {
  rate: number;
}

export interface Picture {
  camera: PerspectiveCamera;
  places: readonly Pose[];
  /** Colour of every body, `0xrrggbb`. */
  colours: number[];
  overlays: ReadonlySet<Overlay>;
  axes: Axis[];
  arrows: Arrow[];
  arrowColour: number;
  shapes: boolean;
  /** A length that looks right for axes and arrows (m). */
  scale: number;
  up: Vector3;
  /** The robot's size (m). */
  size: number;
  theme: Theme;
}

/** Arrows below this part of the largest are not drawn. */
const FAINTEST = 0.03;
/** Most arrows. */
export const ARROWS = 48;

/** Axes of an evaluation as they stand in the frames of their bodies, to be carried along by a motion. */
export function carried(model: Description, evaluation: Evaluation): Axis[] {
  return (evaluation.axes ?? []).map(([ox, oy, oz, ax, ay, az], d) => {
    const dof = model.dofs[d];
    const place = evaluation.places?.[dof?.body ?? -1];
    const [origin, direction] = [new Vector3(ox, oy, oz), new Vector3(ax, ay, az)];
    if (!place) return { origin, direction, slides: dof?.slides ?? false };
    return { origin: within(place, origin), direction: unturned(place, direction), slides: dof?.slides ?? false };
  });
}

/** The same in the world, with the bodies at `places`. */
export function inWorld(model: Description, axes: readonly Axis[], places: readonly Pose[]): Axis[] {
  return axes.map(({ origin, direction, slides }, d) => {
    const place = places[model.dofs[d]?.body ?? -1];
    if (!place) return { origin, direction, slides };
    return { origin: placed(place, origin.toArray()), direction: turned(place, direction), slides };
  });
}

/** The largest parts of a mode, as arrows. */
export function arrows(model: Description, evaluation: Evaluation, axes: readonly Axis[], state: State): Arrow[] {
  const vector = evaluation[state.mode]?.vector;
  if (!vector) return [];
  const largest = Math.max(...vector.map(Math.abs), Number.MIN_VALUE);
  const rates = vector.map((x, row) => ({ d: model.rows[row] ?? -1, rate: x / largest }));
  const shown = rates.filter(({ rate }) => Math.abs(rate) >= FAINTEST).sort((a, b) => Math.abs(b.rate) - Math.abs(a.rate));
  return shown.slice(0, ARROWS).flatMap(({ d, rate }) => (axes[d] ? [{ ...axes[d], rate }] : []));
}

/** The part of a mode that each body's own joint has. */
export function bodyShares(model: Description, evaluation: Evaluation, state: State): number[] {
  const shares = new Array<number>(model.bodies.length).fill(0);
  evaluation[state.mode]?.share.forEach((share, row) => {
    const body = model.dofs[model.rows[row] ?? -1]?.body;
    if (body !== undefined) shares[body] = (shares[body] ?? 0) + share;
  });
  return shares;
}

export function modeColour(state: State, theme: Theme): number {
  return state.mode === "softest" ? theme.blue : theme.vermilion;
}

/** Colours of bodies: from pale to the mode's colour by share, or two tones in turn so that neighbours can be told apart. */
export function colours(model: Description, evaluation: Evaluation, state: State, theme: Theme, hovered: number | null): number[] {
  const lit = hovered === null ? -1 : (model.dofs[model.joints[hovered]?.dofs.at(-1) ?? -1]?.body ?? -1);
  const shares = state.colours ? bodyShares(model, evaluation, state) : null;
  const most = shares ? Math.max(...shares, Number.MIN_VALUE) : 1;
  return model.bodies.map((_, k) => {
    if (k === lit) return theme.lit;
    if (!shares) return k % 2 === 0 ? theme.link : theme.link2;
    return mixed(theme.pale, modeColour(state, theme), Math.sqrt((shares[k] ?? 0) / most));
  });
}
