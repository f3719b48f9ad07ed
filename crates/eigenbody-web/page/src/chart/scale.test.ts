import { expect, test } from "vitest";
import { extent, power, scale } from "./scale";

test("what cannot be drawn does not count", () => {
  expect(extent([null, -1, 0, 2, 50, Number.NaN, Infinity], true)).toEqual({ low: 2, high: 50 });
  expect(extent([null, -1, 3], false)).toEqual({ low: -1, high: 3 });
  expect(extent([null, 0], true)).toBeNull();
});

test("a scale and back", () => {
  for (const log of [false, true]) {
    const axis = scale({ low: 1, high: 1e4 }, log, 10, 210);
    expect([axis.at(1), axis.at(1e4)]).toEqual([10, 210]);
    expect(axis.back(axis.at(37))).toBeCloseTo(37, 9);
  }
});

test("ticks are round", () => {
  expect(scale({ low: -0.31, high: 0.9 }, false, 0, 1).ticks.map(({ label }) => label)).toEqual(["−0.2", "0.0", "0.2", "0.4", "0.6", "0.8"]);
  expect(scale({ low: 1, high: 1e12 }, true, 0, 1).ticks.map(({ label }) => label)).toEqual(["1", "100", "10⁴", "10⁶", "10⁸", "10¹⁰", "10¹²"]);
  expect(scale({ low: 5, high: 5 }, true, 0, 1).ticks.map(({ label }) => label)).toEqual(["2", "5", "10"]);
});

test("one value has a scale too", () => expect(scale({ low: 0, high: 0 }, false, 0, 1).at(0)).toBe(0.5));

test("powers", () => expect([power(1e5), power(2e-7), power(0.5), power(1000), power(1e4)]).toEqual(["10⁵", "2·10⁻⁷", "0.5", "1000", "10⁴"]));
