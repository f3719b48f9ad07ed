import { expect, test } from "vitest";
import { cividis, hex, logPlace, mixed } from "./colour";

test("cividis runs from end to end, as in the report", () => {
  expect([cividis(0), cividis(1), cividis(2), cividis(-1)]).toEqual([[0, 34, 78], [254, 232, 56], [254, 232, 56], [0, 34, 78]]);
});

test("cividis gets lighter all the way", () => {
  const light = Array.from({ length: 101 }, (_, k) => cividis(k / 100)).map(([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b);
  expect(light.every((l, k) => k === 0 || l >= light[k - 1]!)).toBe(true);
});

test("places on a logarithmic scale", () => {
  expect([logPlace(10, 1, 100), logPlace(1, 1, 100), logPlace(5, 5, 5)]).toEqual([0.5, 0, 1]);
});

test("colours between", () => expect([mixed(0x000000, 0xff8040, 0.5), mixed(0x123456, 0xffffff, 0)]).toEqual([0x804020, 0x123456]));

test("colours of the style sheet", () => expect([hex("#0072b2"), hex(" #fff")]).toEqual([0x0072b2, 0xffffff]));
