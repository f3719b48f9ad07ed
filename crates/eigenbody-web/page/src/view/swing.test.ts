import { expect, test } from "vitest";
import type { Description, Evaluation } from "../api/types";
import { FIRST } from "../state/state";
import { swingAmplitude } from "./swing";

const model = { rows: [0, 1], dofs: [{ slides: false }, { slides: true }], extent: 2 } as Description;
const mode = (vector: number[]) => ({ vector, share: vector });
const evaluation = { softest: mode([0.5, 0]), stiffest: mode([1, 0]), kappa: 100 } as Evaluation;

test("the same swing for both modes", () => {
  expect(swingAmplitude(model, evaluation, { ...FIRST, mode: "stiffest" })).toBe(0.45);
});

test("with the same energy the stiffest moves less by √κ, times the modes' shapes", () => {
  expect(swingAmplitude(model, evaluation, { ...FIRST, mode: "stiffest", sameEnergy: true })).toBeCloseTo((0.45 * 2) / 10, 14);
});

test("slides are told by the robot's size", () => {
  expect(swingAmplitude(model, { ...evaluation, softest: mode([0.1, -0.9]) }, FIRST)).toBe(0.4);
});
