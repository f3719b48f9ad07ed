import { expect, test } from "vitest";
import { curveLooks, withPi } from "./figures";

test("curves of two kinds share colours by parameter", () => {
  expect(curveLooks(["zag, a", "zag, b", "curl, a"])).toEqual([{ style: 0, kind: 0 }, { style: 1, kind: 0 }, { style: 0, kind: 1 }]);
  expect(curveLooks(["a", "b"])).toEqual([{ style: 0 }, { style: 1 }]);
});

test("multiples of π", () => {
  expect([withPi(`curl(${Math.PI / 2})`), withPi(`zag(${(3 * Math.PI) / 8})`), withPi("zag(0.1234567)")]).toEqual(["curl(π/2)", "zag(3π/8)", "zag(0.1234567)"]);
});
