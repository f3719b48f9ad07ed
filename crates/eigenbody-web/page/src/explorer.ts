/** The model that is shown, its configuration, and what the server says about it. Panels listen and ask; none talks to another. */

import { ApiError, type Client, type EvaluateQuestion } from "./api/client";
import type { Description, Edits, Evaluation, MatrixPicture, Options, Problem, Source, Start, Want } from "./api/types";
import { Latest } from "./state/latest";
import { NO_EDITS, type State } from "./state/state";

/** What can have changed. `posture`: the q that is asked for; `evaluation`: the answer. */
export type Topic = "model" | "posture" | "evaluation" | "details" | "view" | "tab" | "ends" | "map" | "figure" | "problem" | "hover";

/** What a spectrum and a matrix are made of; for large robots only once q rests. */
export interface Details {
  eigenvalues: number[] | null;
  matrix: MatrixPicture | null;
}

/** A source that gave no model, and why. */
export interface Failure {
  problem: Problem;
  source: Source | null;
}

/** Up to so many DoFs spectrum and matrix are live. */
const LIVE = 120;
/** How long q must rest before a large matrix is asked for (ms). */
const REST = 160;

interface Asked {
  id: string;
  question: EvaluateQuestion;
}

export class Explorer {
  model: Description | null = null;
  evaluation: Evaluation | null = null;
  details: Details | null = null;
  failure: Failure | null = null;
  /** The joint that a pointer or the focus is on. */
  hovered: number | null = null;
  /** Answers so far. */
  updates = 0;
  private opening = 0;
  private rest: ReturnType<typeof setTimeout> | undefined;
  private readonly listeners = new Map<Topic, ((topic: Topic) => void)[]>();
  private readonly light: Latest<Asked, Evaluation>;
  private readonly heavy: Latest<Asked, Evaluation>;

  constructor(
    readonly client: Client,
    readonly start: Start,
    public state: State,
  ) {
    const ask = ({ id, question }: Asked) => client.evaluate(id, question);
    const retry = (error: unknown, asked: Asked) => void this.recover(error, asked);
    this.light = new Latest(ask, (answer, asked, newest) => this.deliver(answer, asked, newest), retry);
    this.heavy = new Latest(ask, (answer, asked) => asked.id === this.model?.id && this.detail(answer), retry);
  }

  on(topics: Topic | Topic[], listener: (topic: Topic) => void): void {
    for (const topic of [topics].flat()) this.listeners.set(topic, [...(this.listeners.get(topic) ?? []), listener]);
  }

  emit(topic: Topic): void {
    this.listeners.get(topic)?.forEach((listener) => listener(topic));
  }

  /** A change of what links hold. */
  update(change: Partial<State>, topic: Topic): void {
    this.state = { ...this.state, ...change };
    this.emit(topic);
  }

  get source(): Source {
    return this.state.source ?? this.start.source;
  }

  /** The configuration that is asked for. */
  get q(): number[] {
    return this.state.q ?? this.model?.q0 ?? [];
  }

  /** Shows another model, at `at` if that is given. On failure the present one stays, and `failure` says why. */
  async open(source: Source | null, options: Partial<Options> = {}, edits: Edits = NO_EDITS, at: { config?: string; q?: number[] | null } = {}): Promise<boolean> {
    const turn = ++this.opening;
    try {
      const model = await this.client.model({ source: source ?? this.start.source, options, edits });
      const q = at.q ?? (at.config ? (await this.client.pose(model.id, at.config)).q : null);
      if (turn !== this.opening) return false;
      const same = this.model !== null && this.model.name === model.name && this.model.nq === model.nq;
      const fits = (ends: number[] | null) => (ends?.length === model.nq ? ends : null);
      this.state = {
        ...this.state,
        source,
        options,
        edits,
        q: fits(q),
        a: same ? fits(this.state.a) : null,
        b: same ? fits(this.state.b) : null,
        map: same ? this.state.map : null,
      };
      [this.model, this.evaluation, this.details] = [model, null, null];
      this.fail(null);
      this.emit("model");
      this.ask();
      return true;
    } catch (error) {
      if (turn === this.opening) this.fail(error, source);
      return false;
    }
  }

  /** The present model with other new values, in the same configuration. */
  edit(edits: Edits): Promise<boolean> {
    return this.open(this.state.source, this.state.options, edits, { q: this.state.q });
  }

  /** The first model of a page: what the link says, then where it says. */
  async restore(): Promise<boolean> {
    const { source, options, edits, q, a, b, map, eye } = this.state;
    const given = source ? options : { ...this.start.options, ...options };
    if (!(await this.open(source, given, edits, { q }))) return false;
    this.state = { ...this.state, a: a?.length === this.model?.nq ? a : null, b: b?.length === this.model?.nq ? b : null, map, eye };
    this.emit("ends");
    this.emit("map");
    return true;
  }

  /** Moves the robot. */
  pose(q: number[]): void {
    this.state = { ...this.state, q };
    this.emit("posture");
    this.ask();
  }

  /** Moves the robot to where a text says: `zag(pi/2)`, `random(7)`, a keyframe. */
  async poseBy(config: string): Promise<boolean> {
    const model = this.model;
    if (!model) return false;
    return this.attempt(async () => {
      const { q } = await this.client.pose(model.id, config);
      if (this.model?.id === model.id) this.pose(q);
    });
  }

  /** Does what can fail; a failure is shown. */
  async attempt(action: () => Promise<void>): Promise<boolean> {
    try {
      await action();
      if (this.failure?.source === null) this.fail(null);
      return true;
    } catch (error) {
      this.fail(error);
      return false;
    }
  }

  /** Asks again for the present configuration. */
  ask(): void {
    const { model } = this;
    if (!model) return;
    const want: Want[] = ["places", "numbers", "modes"];
    const details = this.state.tab === "analysis";
    const live = model.nv <= LIVE;
    if (details && live) want.push("eigenvalues", "matrix");
    this.light.put({ id: model.id, question: { q: this.q, metric: this.state.metric, want, pool: 128 } });
    clearTimeout(this.rest);
    if (details && !live) this.rest = setTimeout(() => this.askDetails(), REST);
  }

  hover(joint: number | null): void {
    if (joint === this.hovered) return;
    this.hovered = joint;
    this.emit("hover");
  }

  private askDetails(): void {
    if (!this.model) return;
    if (this.light.busy) {
      this.rest = setTimeout(() => this.askDetails(), REST);
      return;
    }
    this.heavy.put({ id: this.model.id, question: { q: this.q, metric: this.state.metric, want: ["eigenvalues", "matrix"], pool: 128 } });
  }

  private deliver(answer: Evaluation, { id, question }: Asked, newest: boolean): void {
    if (id !== this.model?.id) return;
    this.evaluation = answer;
    this.updates += 1;
    if (newest && this.failure?.source === null) this.fail(null);
    this.emit("evaluation");
    if (question.want.includes("matrix")) this.detail(answer);
  }

  private detail(answer: Evaluation): void {
    this.details = { eigenvalues: answer.eigenvalues ?? null, matrix: answer.matrix ?? null };
    this.emit("details");
  }

  /** A server that has let go of the model gets it again; one that is busy, a moment. */
  private async recover(error: unknown, { id }: Asked): Promise<void> {
    const code = error instanceof ApiError ? error.problem.code : "";
    if (id !== this.model?.id) return;
    if (code === "busy") {
      setTimeout(() => this.ask(), REST);
    } else if (code === "gone") {
      const { source, options, edits, q } = this.state;
      await this.open(source, options, edits, { q });
    } else {
      this.fail(error);
    }
  }

  fail(error: unknown, source: Source | null = null): void {
    const problem = error instanceof ApiError ? error.problem : { code: "page", message: String(error instanceof Error ? error.message : error) };
    const failure = error === null ? null : { problem, source };
    if (failure === null && this.failure === null) return;
    this.failure = failure;
    this.emit("problem");
  }
}
