import { expect, test } from "vitest";
import { parseFamily } from "./models";

test.each([
  ["hydra(40,1,0,1)", { name: "hydra", values: [40, 1, 0, 1] }],
  [" onion(33, 1.125, 0, 1) ", { name: "onion", values: [33, 1.125, 0, 1] }],
  ["chain(4, m=2.2, l=1)", { name: "chain", values: [4, 2.2, 1] }],
  ["hydra(40,1,pi/2,1)", { name: "hydra", values: [40, 1, Math.PI / 2, 1] }],
])("%s", (text, family) => expect(parseFamily(text)).toEqual(family));

test.each(["hydra", "hydra(40", "hydra(x)", "hydra(1+1)", "robot.urdf"])("%s has no sliders", (text) => expect(parseFamily(text)).toBeNull());
