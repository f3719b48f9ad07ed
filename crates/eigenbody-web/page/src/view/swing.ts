/** A mode as motion: frames by the server, which moves joints along the mode exactly, played as a sine. */

import type { Description, Evaluation, Pose } from "../api/types";
import type { Explorer } from "../explorer";
import { Latest } from "../state/latest";
import type { ModeChoice, State } from "../state/state";
import { between } from "./frames";

/** Period of the motion (s). */
const PERIOD = 2.6;
/** Largest turn (rad), and largest slide over the robot's extent. */
const TURN = 0.45;
const SLIDE = 0.2;

interface Asked {
  id: string;
  q: number[];
  mode: ModeChoice;
  metric: string;
  amplitude: number;
  frames: number;
}

export class Swing {
  /** Place in the motion: 0 rest, a quarter one end. */
  phase = 0;
  private frames: Pose[][] = [];
  private key = "";
  private readonly latest: Latest<Asked, Pose[][]>;

  constructor(private readonly explorer: Explorer, changed: () => void) {
    this.latest = new Latest(
      async ({ id, ...asked }) => (await explorer.client.swing(id, asked)).places,
      (frames) => {
        this.frames = frames;
        changed();
      },
      (error) => explorer.fail(error),
    );
  }

  /** Asks for frames, if the motion is wanted and another than that at hand. */
  follow(): void {
    const { model, evaluation, state } = this.explorer;
    if (!state.swinging || !model || !evaluation?.places) {
      this.frames = [];
      this.key = "";
      return;
    }
    const amplitude = swingAmplitude(model, evaluation, state);
    const asked = { id: model.id, q: evaluation.q, mode: state.mode, metric: state.metric, amplitude, frames: Math.min(model.limits.frames, 25) };
    const key = JSON.stringify(asked);
    if (key === this.key) return;
    this.key = key;
    if (evaluation[state.mode]) this.latest.put(asked);
    else this.frames = [];
  }

  advance(seconds: number): void {
    this.phase = (this.phase + seconds / PERIOD) % 1;
  }

  /** Where the bodies are now; none while there is no motion. */
  places(): Pose[] | null {
    const { frames } = this;
    if (frames.length < 2) return null;
    const at = ((1 + Math.sin(2 * Math.PI * this.phase)) / 2) * (frames.length - 1);
    const k = Math.min(frames.length - 2, Math.floor(at));
    const [a, b] = [frames[k]!, frames[k + 1]!];
    return a.map((pose, body) => between(pose, b[body]!, at - k));
  }
}

/** The largest rate of a mode, in multiples of what a swing may be. */
function largest(model: Description, vector: readonly number[]): { rate: number; reach: number } {
  let [rate, reach] = [0, TURN];
  vector.forEach((x, row) => {
    if (Math.abs(x) <= rate) return;
    rate = Math.abs(x);
    reach = model.dofs[model.rows[row] ?? -1]?.slides ? SLIDE * model.extent : TURN;
  });
  return { rate, reach };
}

/**
 * How far the mode's fastest joint swings (rad, m).
 *
 * With the same energy ½ λ ẋ², the mode x of eigenvalue λ moves by x/√λ: the stiffest less than the softest by √κ and by their shapes.
 */
export function swingAmplitude(model: Description, evaluation: Evaluation, state: State): number {
  const { softest, stiffest, kappa } = evaluation;
  const own = largest(model, evaluation[state.mode]?.vector ?? []);
  if (!state.sameEnergy || state.mode === "softest" || !softest || !stiffest || !kappa) return own.reach;
  const soft = largest(model, softest.vector);
  return (soft.reach / soft.rate) * (own.rate / Math.sqrt(kappa));
}
