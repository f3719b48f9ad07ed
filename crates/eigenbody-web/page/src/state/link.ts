/**
 * The state as the part of a link behind `#`, and back: `#m=hydra(40,1,0,1)&q=0.1,0.2&o=axes,arrows`.
 *
 * What has its first value is left out. Numbers are written so that they parse back to the same bits. The text of a dropped file is packed
 * into the link if it is short enough.
 */

import type { Edits, Options, Source } from "../api/types";
import { pack, unpack } from "./pack";
import { FIRST, OVERLAYS, rounded, TABS, type EyeState, type Overlay, type State, type Tab } from "./state";

/** Longest packed file in a link (characters); browsers take links of about two million. */
export const LONGEST_FILE = 64 * 1024;

/** The state as a link's hash, without the `#`; `whole` is false if a file was too long for it. */
export async function toLink(state: State): Promise<{ hash: string; whole: boolean }> {
  const words: [string, string][] = [];
  const put = (name: string, value: string | null) => value !== null && words.push([name, value]);
  let whole = true;
  const source = state.source;
  if (source && "family" in source) put("m", source.family);
  if (source && "builtin" in source) put("robot", source.builtin);
  if (source && "text" in source) {
    const packed = await pack(source.text);
    whole = packed.length <= LONGEST_FILE;
    if (whole) {
      put("file", source.name);
      put("text", packed);
    }
  }
  const { base, reduced, mimic, rotors } = state.options;
  put("base", base === "floating" ? base : null);
  put("reduced", reduced ? "1" : null);
  put("mimic", mimic === false ? "0" : null);
  put("rotors", rotors ? "1" : null);
  for (const [name, value] of Object.entries(state.edits.armature)) put("armature", `${value}:${name}`);
  for (const [name, value] of Object.entries(state.edits.mass)) put("mass", `${value}:${name}`);
  put("q", numbers(state.q));
  put("metric", unless(state.metric, FIRST.metric));
  put("tab", unless(state.tab, FIRST.tab));
  put("show", unless([...state.overlays].sort().join(","), [...FIRST.overlays].sort().join(",")));
  put("mode", unless(state.mode, FIRST.mode));
  put("colours", state.colours ? "1" : null);
  put("shapes", state.shapes ? null : "0");
  put("swing", state.swinging ? "1" : null);
  put("energy", state.sameEnergy ? "1" : null);
  put("eye", unless(eyeText(state.eye), eyeText(FIRST.eye)));
  put("a", numbers(state.a));
  put("b", numbers(state.b));
  put("x", state.map?.[0] ?? null);
  put("y", state.map?.[1] ?? null);
  put("figure", state.figure);
  return { hash: words.map(([name, value]) => `${name}=${escaped(value)}`).join("&"), whole };
}

/** The state of a link's hash. What it does not say, or says wrongly, has its first value. */
export async function fromLink(hash: string): Promise<State> {
  const words = new URLSearchParams(hash.replace(/^#/, "").replaceAll("+", "%2B"));
  const one = <T extends string>(name: string, allowed: readonly T[], otherwise: T): T => allowed.find((value) => value === words.get(name)) ?? otherwise;
  const flag = (name: string, otherwise: boolean) => (words.has(name) ? words.get(name) === "1" : otherwise);
  const options: Partial<Options> = {};
  if (words.get("base") === "floating") options.base = "floating";
  if (words.get("reduced") === "1") options.reduced = true;
  if (words.get("mimic") === "0") options.mimic = false;
  if (words.get("rotors") === "1") options.rotors = true;
  const [x, y] = [words.get("x"), words.get("y")];
  const eye = list(words.get("eye"));
  return {
    source: await source(words),
    options,
    edits: { armature: edits(words.getAll("armature")), mass: edits(words.getAll("mass")) },
    q: list(words.get("q")),
    metric: words.get("metric") ?? FIRST.metric,
    tab: one<Tab>("tab", TABS, FIRST.tab),
    overlays: words.has("show") ? new Set<Overlay>(OVERLAYS.filter((name) => words.get("show")?.split(",").includes(name))) : FIRST.overlays,
    mode: one("mode", ["softest", "stiffest"] as const, FIRST.mode),
    colours: flag("colours", FIRST.colours),
    shapes: flag("shapes", FIRST.shapes),
    swinging: flag("swing", FIRST.swinging),
    sameEnergy: flag("energy", FIRST.sameEnergy),
    eye: eye?.length === 6 ? { azimuth: eye[0]!, elevation: eye[1]!, distance: eye[2]!, target: [eye[3]!, eye[4]!, eye[5]!] } : FIRST.eye,
    a: list(words.get("a")),
    b: list(words.get("b")),
    map: x !== null && y !== null ? [x, y] : null,
    figure: words.get("figure"),
  };
}

async function source(words: URLSearchParams): Promise<Source | null> {
  const [family, builtin, name, packed] = ["m", "robot", "file", "text"].map((key) => words.get(key)) as (string | null)[];
  if (family) return { family };
  if (builtin) return { builtin };
  if (!name || !packed) return null;
  const text = await unpack(packed).catch(() => null);
  return text === null ? null : { text, name };
}

/** Characters that a link may hold as they are stay legible. */
function escaped(value: string): string {
  return encodeURIComponent(value).replace(/%(2C|3A|2F|3D|40)/g, (code) => decodeURIComponent(code));
}

function unless(value: string, first: string): string | null {
  return value === first ? null : value;
}

function numbers(values: readonly number[] | null): string | null {
  return values && values.map((x) => (Object.is(x, -0) ? "0" : String(x))).join(",");
}

function eyeText(eye: EyeState): string {
  const { azimuth, elevation, distance, target } = rounded(eye);
  return [azimuth, elevation, distance, ...target].join(",");
}

function list(text: string | null): number[] | null {
  if (!text) return null;
  const values = text.split(",").map((word) => (word.trim() ? Number(word) : Number.NaN));
  return values.every(Number.isFinite) ? values : null;
}

function edits(words: string[]): Edits["mass"] {
  const pairs = words.map((word) => [word.slice(word.indexOf(":") + 1), Number(word.slice(0, word.indexOf(":")))] as const);
  return Object.fromEntries(pairs.filter(([name, value]) => name && Number.isFinite(value)));
}

