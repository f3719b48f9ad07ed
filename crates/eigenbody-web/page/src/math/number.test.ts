import { describe, expect, test } from "vitest";
import { estimate, shown, significant, typed } from "./number";

describe("significant", () => {
  // What `eigenbody_report::significant` prints for the same numbers.
  test.each([
    [42907.97274937, 6, "42908.0"],
    [0.021146, 3, "0.0211"],
    [8.1053e10, 3, "8.11e10"],
    [0.00001, 6, "1.00000e-5"],
    [9999999.4, 6, "9999999"],
    [1e7, 6, "1.00000e7"],
    [-39.4606, 6, "-39.4606"],
    [0, 6, "0"],
    [1234567, 6, "1234567"],
  ])("%f to %i digits", (x, digits, text) => expect(significant(x, digits)).toBe(text));

  test("ties go to even", () => {
    expect(significant(100000.5, 6)).toBe("100000");
    expect(significant(100001.5, 6)).toBe("100002");
    expect(significant(-100000.5, 6)).toBe("-100000");
  });
});

test("a missing number is a dash, a minus a minus", () => {
  expect([shown(null), shown(-0.5), estimate(5.2e-14), estimate(null)]).toEqual(["–", "−0.500000", "5e−14", ""]);
});

describe("typed", () => {
  test.each([["pi/2", Math.PI / 2], ["-3pi/4", -3 * Math.PI / 4], ["0.1", 0.1], ["−π", -Math.PI], ["1e-3", 1e-3], [" 2 ", 2], ["0,5", 0.5]])(
    "%s", (text, x) => expect(typed(text)).toBeCloseTo(x as number, 15));
  test.each(["", "abc", "1/0", "pi pi", "."])("%s is no number", (text) => expect(typed(text)).toBeNull());
});
