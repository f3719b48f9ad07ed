import { expect, test } from "vitest";
import { fromLink, LONGEST_FILE, toLink } from "./link";
import { FIRST, type Overlay, type State } from "./state";

const FULL: State = {
  source: { family: "hydra(40,1,0,1)" },
  options: { base: "floating", reduced: true, mimic: false, rotors: true },
  edits: { armature: { "a:b,c": 0.1, "ü &=#+%": 1e-300 }, mass: { forearm: 2.5 } },
  q: [0.1, -Math.PI, 1 / 3, 5e-324],
  metric: "length=0.3",
  tab: "line",
  overlays: new Set<Overlay>(["centres"]),
  mode: "stiffest",
  colours: true,
  shapes: false,
  swinging: true,
  sameEnergy: true,
  eye: { azimuth: 1.25, elevation: -0.5, distance: 3, target: [0.1, 0, -2] },
  a: [0, 0, 0, 0],
  b: [1, 2, 3, 4],
  map: ["left hip", "right_knee"],
  figure: "F-fig6",
};

const round = async (state: State) => fromLink(`#${(await toLink(state)).hash}`);

test("nothing to say, nothing said", async () => {
  expect((await toLink(FIRST)).hash).toBe("");
  expect(await fromLink("")).toEqual(FIRST);
});

test("everything goes through a link and back, to the bit", async () => expect(await round(FULL)).toEqual(FULL));

test("so does a file", async () => {
  const state: State = { ...FIRST, source: { name: "Roboter ö.urdf", text: "<robot name='ü'>\r\n</robot>\n" } };
  expect(await round(state)).toEqual(state);
});

test("a file that is too long is left out, and said so", async () => {
  let seed = 1;
  const noise = Array.from({ length: 2 * LONGEST_FILE }, () => String.fromCharCode(33 + ((seed = (seed * 48271) % 2147483647) % 90))).join("");
  const link = await toLink({ ...FIRST, source: { name: "long.urdf", text: noise } });
  expect(link).toEqual({ hash: "", whole: false });
});

test("families stay legible", async () => {
  const { hash } = await toLink({ ...FIRST, source: { family: "hydra(40,1,0,1)" }, q: [0.5, 1] });
  expect(hash).toBe("m=hydra(40,1,0,1)&q=0.5,1");
});

test.each(["q=1,x", "q=", "eye=1,2", "tab=no", "text=%%%&file=a", "armature=x:y", "show=nothing"])("%s is taken as nothing", async (hash) => {
  const state = await fromLink(hash);
  expect({ ...state, overlays: FIRST.overlays }).toEqual(FIRST);
});
