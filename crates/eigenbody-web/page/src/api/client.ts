/** The server's endpoints as functions. */

import type {
  Check, Description, Edits, Evaluation, Figure, KappaMap, Options, Patch, PatchFormat, Path, Problem, Source, Start, Swing, Triangles, Want,
} from "./types";

/** An answer that says what is wrong, and where. */
export class ApiError extends Error {
  constructor(readonly problem: Problem) {
    super(problem.message);
  }
}

export interface ModelQuestion {
  source: Source;
  options?: Partial<Options>;
  edits?: Edits;
}

export interface EvaluateQuestion {
  q: number[];
  metric: string;
  want: Want[];
  pool?: number;
}

export type ModeName = "softest" | "stiffest";

export class Client {
  constructor(private readonly token: string) {}

  start(): Promise<Start> {
    return this.call("GET", "start");
  }

  model(question: ModelQuestion): Promise<Description> {
    return this.call("POST", "model", question);
  }

  evaluate(id: string, question: EvaluateQuestion): Promise<Evaluation> {
    return this.call("POST", "evaluate", { id, ...question });
  }

  pose(id: string, at: string): Promise<{ q: number[] }> {
    return this.call("POST", "pose", { id, at });
  }

  move(id: string, q: number[], v: number[]): Promise<{ q: number[] }> {
    return this.call("POST", "move", { id, q, v });
  }

  between(id: string, q: number[], to: number[], t: number): Promise<{ q: number[] }> {
    return this.call("POST", "move", { id, q, to, t });
  }

  swing(id: string, question: { q: number[]; mode: ModeName; metric: string; amplitude: number; frames: number }): Promise<Swing> {
    return this.call("POST", "swing", { id, ...question });
  }

  path(id: string, question: { from: number[]; to: number[]; points: number; metric: string }): Promise<Path> {
    return this.call("POST", "path", { id, ...question });
  }

  map(id: string, question: { q: number[]; dofs: [number, number]; resolution: number; metric: string }): Promise<KappaMap> {
    return this.call("POST", "map", { id, ...question });
  }

  /** The server stops working on it when `signal` is aborted. */
  check(id: string, metric: string, signal: AbortSignal): Promise<Check> {
    return this.call("POST", "check", { id, metric }, signal);
  }

  patch(id: string, format: PatchFormat): Promise<Patch> {
    return this.call("POST", "patch", { id, format });
  }

  mesh(k: number): Promise<Triangles> {
    return this.call("GET", `mesh/${k}`);
  }

  figure(id: string): Promise<Figure> {
    return this.call("GET", `figure/${encodeURIComponent(id)}`);
  }

  private async call<Answer>(method: "GET" | "POST", path: string, body?: object, signal: AbortSignal | null = null): Promise<Answer> {
    const headers: Record<string, string> = { "X-Eigenbody-Token": this.token };
    if (body) headers["Content-Type"] = "application/json";
    const request: RequestInit = body ? { method, headers, signal, body: JSON.stringify(body) } : { method, headers, signal };
    const answer = await fetch(`/api/${path}`, request).catch(() => {
      throw new ApiError({ code: "gone-away", message: "the server does not answer: is `eigenbody serve` still running?" });
    });
    const json = (await answer.json().catch(() => null)) as { error?: Problem } | null;
    if (answer.ok && json) return json as Answer;
    throw new ApiError(json?.error ?? { code: "internal", message: `the server answered ${answer.status} without a reason` });
  }
}
