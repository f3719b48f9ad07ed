/** What the server says and hears: crates/eigenbody-web/API.md in types. SI units; a number that does not exist is null. */

export type Vec3 = [number, number, number];
/** x, y, z, then a unit quaternion w, x, y, z. */
export type Pose = [number, number, number, number, number, number, number];
export type Maybe = number | null;

export type Source =
  | { family: string }
  | { builtin: string }
  | { opened: true }
  | { text: string; name: string };

export interface Options {
  base: "fixed" | "floating";
  reduced: boolean;
  mimic: boolean;
  rotors: boolean;
}

/** New values by names of DoFs and links. */
export interface Edits {
  armature: Record<string, number>;
  mass: Record<string, number>;
}

export interface Parameter {
  name: string;
  label: string;
  min: number;
  max: number;
  step: number;
  default: number;
  integer: boolean;
  unit: string;
}

export interface FamilyAbout {
  name: string;
  usage: string;
  parameters: Parameter[];
}

export interface FigureAbout {
  id: string;
  title: string;
  seen: string;
}

export interface Start {
  version: string;
  source: Source;
  options: Partial<Options>;
  families: FamilyAbout[];
  builtins: { name: string; title: string }[];
  figures: FigureAbout[];
  limits: { dofs: number; text: number };
}

export type ShapeKind = "box" | "sphere" | "cylinder" | "capsule" | "ellipsoid" | "plane" | "mesh";

export interface Shape {
  kind: ShapeKind;
  size: number[];
  pose: Pose;
  mesh?: number;
}

export interface Triangles {
  positions: number[];
  indices: number[];
}

export interface Body {
  link: string;
  parent: number | null;
  mass: number;
  centre: Vec3;
  dofs: number[];
  box: { pose: Pose; half: Vec3 } | null;
  shapes: Shape[];
}

export interface Dof {
  name: string;
  joint: number;
  body: number;
  slides: boolean;
  armature: number;
}

export interface Joint {
  name: string;
  kind: string;
  /** Where its coordinates begin in q. */
  q: number;
  nq: number;
  dofs: number[];
  limits: [number, number] | null;
  range: [number, number];
  unit: string;
  follows: string | null;
}

export interface Place {
  file: string;
  line: number;
  column: number;
}

export interface Finding {
  code: string;
  subject: string;
  message: string;
  place: Place | null;
}

export type PatchFormat = "urdf" | "mjcf";

export interface Description {
  id: string;
  name: string;
  robot: string;
  source: Source;
  options: Options;
  edits: Edits;
  format: string;
  text?: string | null;
  nq: number;
  nv: number;
  mass: number;
  gravity: Vec3;
  extent: number;
  can: { float: boolean; mimic: boolean; rotors: boolean };
  bodies: Body[];
  still: Shape[];
  dofs: Dof[];
  rows: number[];
  joints: Joint[];
  coordinates: { name: string; unit: string }[];
  keyframes: { name: string; q: number[] }[];
  q0: number[];
  unit: string;
  findings: Finding[];
  patch: { urdf: boolean; mjcf: boolean; why: Record<PatchFormat, string | null> };
  limits: { map: number; path: number; frames: number };
}

export interface Mode {
  vector: number[];
  share: number[];
}

export type Want = "places" | "numbers" | "modes" | "eigenvalues" | "matrix";

export interface MatrixPicture {
  rows: number;
  pooled: number;
  size: number;
  values: number[];
}

export interface Numbers {
  metric: string;
  unit: string;
  method: string;
  kappa: Maybe;
  kappa_weighted: Maybe;
  diagonal_ratio: Maybe;
  lambda_min: Maybe;
  lambda_max: Maybe;
  bracket: [number, number] | null;
  error_estimate: { lambda_min: Maybe; lambda_max: Maybe };
  note?: string | null;
}

export interface Evaluation extends Partial<Numbers> {
  q: number[];
  places?: Pose[];
  axes?: [number, number, number, number, number, number][];
  softest?: Mode | null;
  stiffest?: Mode | null;
  eigenvalues?: number[] | null;
  matrix?: MatrixPicture | null;
}

export interface Swing {
  amplitude: number;
  places: Pose[][];
}

export interface Path {
  t: number[];
  kappa: Maybe[];
  kappa_weighted: Maybe[];
  lambda_min: Maybe[];
  lambda_max: Maybe[];
}

export interface KappaMap {
  x: number[];
  y: number[];
  kappa: Maybe[][];
  kappa_weighted: Maybe[][];
}

export interface FigurePoint {
  x: number;
  y: number;
  source: Source | null;
  options: Partial<Options>;
  at: string;
}

export interface Figure {
  id: string;
  title: string;
  seen: string;
  paper: string;
  x: { label: string; log: boolean };
  y: { label: string; log: boolean };
  curves: { name: string; points: FigurePoint[] }[];
}

export interface Patch {
  name: string;
  text: string;
  note: string | null;
}

/** A finding of `eigenbody check`. */
export interface CheckFinding {
  id: string;
  severity: "error" | "warning" | "note";
  message: string;
  advice: string;
  joints: string[];
  q: number[];
  place: Place | null;
}

/** What `eigenbody check --format json` prints, as far as the page shows it. */
export interface Check {
  evaluations: number;
  worst: { measure: "kappa" | "kappa_weighted" | "lambda_min"; worst: Maybe; median: Maybe; q: number[] }[];
  findings: CheckFinding[];
}

export interface Problem {
  code: string;
  message: string;
  file?: string;
  line?: number;
  column?: number;
  what?: string;
  excerpt?: string;
}
