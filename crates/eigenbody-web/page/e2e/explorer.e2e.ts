/** The explorer as people use it. */

import { readFileSync, writeFileSync } from "node:fs";
import { mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from "vitest";
import { coordinates, drop, FIXTURES, g1, inked, NARROW, NO_WEBGL, reading, Server, Session, settled, spectrum, type Reading } from "./harness";
import { cancelledCheck, countPictures, pace, reactions } from "./pace";

const READINGS: Reading[] = ["kappa", "kappa_weighted", "lambda_min", "lambda_max"];
const arm = readFileSync(join(FIXTURES, "arm.urdf"), "utf8");
const broken = readFileSync(join(FIXTURES, "broken.urdf"), "utf8");

let server: Server;
let session: Session;
beforeAll(async () => {
  server = await Server.start("puma560", "--port", "0");
});
afterAll(() => server.stop());
beforeEach(async () => {
  session = await Session.start(server.url);
});
afterEach(() => session.stop());

/** The page's numbers are those that the command line prints for the page's configuration, to the bit. */
async function agrees(page: Page, model: string, ...more: string[]): Promise<void> {
  await settled(page);
  const told = spectrum(model, coordinates(page), ...more);
  for (const name of READINGS) expect([name, await reading(page, name)]).toEqual([name, told[name]]);
}

/** Drags a slider by its thumb to a part of its length. */
async function slide(page: Page, label: string, part: number): Promise<void> {
  const slider = page.getByRole("slider", { name: label, exact: true });
  await slider.scrollIntoViewIfNeeded();
  const box = (await slider.boundingBox())!;
  const y = box.y + box.height / 2;
  const [low, high, value] = await slider.evaluate((input: HTMLInputElement) => [Number(input.min), Number(input.max), Number(input.value)] as const);
  await page.mouse.move(box.x + 8 + ((value - low) / (high - low)) * (box.width - 16), y);
  await page.mouse.down();
  for (let k = 1; k <= 12; k++) await page.mouse.move(box.x + box.width * (0.5 + (part - 0.5) * (k / 12)), y);
  await page.mouse.up();
}

/** Somewhere on the robot: where the pointer finds a joint to move. It rests there. */
async function grabbable(page: Page, box: { x: number; y: number; width: number; height: number }): Promise<{ x: number; y: number }> {
  for (let k = 20; k < 80; k++) {
    const point = { x: box.x + (box.width * k) / 100, y: box.y + box.height * 0.5 };
    await page.mouse.move(point.x, point.y);
    if (await page.locator(".stage canvas.grab").count()) return point;
  }
  throw new Error("nothing in the view can be grabbed");
}

const tab = (page: Page, name: string) => page.getByRole("tab", { name }).click();

test("a slider moves a built-in arm, and κ is what the command line says", async () => {
  const page = await session.page();
  await settled(page);
  const before = await reading(page, "kappa");
  await slide(page, "joint_3", 0.8);
  await agrees(page, "puma560");
  expect(await reading(page, "kappa")).not.toBe(before);
  expect(coordinates(page).filter((x) => x !== 0)).toHaveLength(1);
  session.clean();
});

test("a joint is dragged in the view", async () => {
  const page = await session.page("m=hydra(4,1,0,1)&q=0.3,0.3,0.3,0.3&show=skeleton&eye=0.4,0,14,2,0.5,0");
  await settled(page);
  const at = await grabbable(page, (await page.locator(".stage canvas").boundingBox())!);
  await page.mouse.down();
  for (let k = 1; k <= 8; k++) await page.mouse.move(at.x, at.y - 6 * k);
  await page.mouse.up();
  await agrees(page, "hydra(4,1,0,1)");
  expect(coordinates(page).filter((x) => x !== 0.3)).toHaveLength(1);
  session.clean();
});

test("a file with an error is refused at its line, and the robot before stays", async () => {
  const page = await session.page();
  await settled(page);
  await drop(page, "broken.urdf", broken);
  const line = page.locator('.text li[data-line="14"]');
  await line.waitFor();
  expect(await line.textContent()).toContain('<mass value="two"/>');
  expect(await line.locator(".note.error").textContent()).toContain("expected a finite number");
  expect(await page.getByRole("alert").textContent()).toContain("broken.urdf:14:13");
  expect(await page.getByRole("heading", { level: 1 }).textContent()).toContain("puma560");
  // The browser itself says on the console that an answer was 422.
  session.clean([/status of 422/]);
});

test("a file with a fault shows it at its line; with another armature κ is another", async () => {
  const page = await session.page();
  await settled(page);
  await drop(page, "arm.urdf", arm);
  await page.locator('.text li[data-line="18"] .note').waitFor();
  expect(await page.locator('.text li[data-line="18"]').textContent()).toContain("not physical");
  await agrees(page, join(FIXTURES, "arm.urdf"));
  const before = await reading(page, "kappa");
  const box = page.getByRole("textbox", { name: "wrist (kg m²)" });
  await box.fill("0.1");
  await box.press("Enter");
  await expect.poll(() => reading(page, "kappa")).toBeLessThan(before / 50);
  await settled(page);

  // The saved file, read by the command line, has the same κ.
  const download = page.waitForEvent("download");
  await page.getByRole("button", { name: "Save as MJCF" }).click();
  const patch = join(mkdtempSync(join(tmpdir(), "eigenbody-e2e-")), "arm.xml");
  await (await download).saveAs(patch);
  const told = spectrum(patch, coordinates(page));
  const kappa = await reading(page, "kappa");
  expect(Math.abs(told.kappa / kappa - 1)).toBeLessThan(1e-12);
  session.clean();
});

test("a file is chosen by keyboard too, and its mass changed", async () => {
  const page = await session.page();
  await settled(page);
  await page.locator('header input[type="file"]').setInputFiles(join(FIXTURES, "arm.urdf"));
  await page.getByRole("heading", { level: 1, name: "arm.urdf" }).waitFor();
  await settled(page);
  const before = await reading(page, "lambda_max");
  const box = page.getByRole("textbox", { name: "forearm (kg)" });
  await box.fill("4");
  await box.press("Enter");
  await expect.poll(() => reading(page, "lambda_max")).toBeGreaterThan(1.3 * before);
  // What is dropped is as the command line has it, changed by hand.
  const heavy = join(mkdtempSync(join(tmpdir(), "eigenbody-e2e-")), "heavy.urdf");
  writeFileSync(heavy, arm.replace('<mass value="2"/>\n      <inertia ixx="0.016" iyy="0.016" izz="0.0016"', '<mass value="4"/>\n      <inertia ixx="0.032" iyy="0.032" izz="0.0032"'));
  expect(Math.abs((await reading(page, "lambda_max")) / spectrum(heavy, [0, 0, 0]).lambda_max - 1)).toBeLessThan(1e-12);
  session.clean();
});

test("a file's own shapes are drawn, or the boxes of its inertias", async () => {
  const page = await session.page("show=none");
  await settled(page);
  const shape = (xyz: string, geometry: string) => `</inertial><visual><origin xyz="${xyz}"/><geometry>${geometry}</geometry></visual>`;
  const shapes = [shape("0 0 0.2", '<cylinder radius="0.03" length="0.4"/>'), shape("0 0 0.15", '<box size="0.05 0.05 0.3"/>'), shape("0 0 0.05", '<sphere radius="0.05"/>')];
  await drop(page, "drawn.urdf", arm.replaceAll("</inertial>", () => shapes.shift()!));
  await page.getByRole("heading", { level: 1, name: "drawn.urdf" }).waitFor();
  await settled(page);
  const visuals = page.getByRole("checkbox", { name: "visuals of the file" });
  const drawn = await inked(page);
  await visuals.uncheck();
  await page.waitForTimeout(600);
  // The hand's inertia is that of a wide plate.
  expect(await inked(page)).toBeGreaterThan(1.2 * drawn);
  expect(drawn).toBeGreaterThan(500);
  session.clean();
});

test("visuals of an SDF file", async () => {
  const page = await session.page("show=none");
  await settled(page);
  const link = (name: string, pose: string, geometry: string) =>
    `<link name="${name}"><pose>${pose}</pose><visual name="v"><pose>0 0 0.2 0 0 0</pose><geometry>${geometry}</geometry></visual></link>`;
  const joint = (name: string, parent: string, child: string) =>
    `<joint name="${name}" type="revolute"><parent>${parent}</parent><child>${child}</child><axis><xyz>1 0 0</xyz></axis></joint>`;
  await drop(page, "arm.sdf", `<sdf version="1.9"><model name="arm">${link("a", "0 0 0 0 0 0", "<box><size>0.1 0.1 0.4</size></box>")}
    ${link("b", "0 0 0.4 0 0 0", "<capsule><radius>0.04</radius><length>0.3</length></capsule>")}${joint("j1", "world", "a")}${joint("j2", "a", "b")}</model></sdf>`);
  await page.getByRole("heading", { level: 1, name: "arm.sdf" }).waitFor();
  await settled(page);
  const drawn = await inked(page);
  // Of links that say nothing the inertia is that of a cube of 2.4 m.
  await page.getByRole("checkbox", { name: "visuals of the file" }).uncheck();
  await page.waitForTimeout(600);
  expect(await inked(page)).toBeGreaterThan(2 * drawn);
  expect(drawn).toBeGreaterThan(200);
  session.clean();
});

test("meshes of the file that the server was started with", async () => {
  const folder = mkdtempSync(join(tmpdir(), "eigenbody-e2e-"));
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, k & 2, k & 4].map((bit) => (bit ? 1 : -1)));
  const faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"];
  writeFileSync(join(folder, "cube.obj"), [...corners.map((corner) => `v ${corner.join(" ")}`), ...faces.map((face) => `f ${face}`)].join("\n"));
  const mesh = '</inertial><visual><geometry><mesh filename="cube.obj" scale="0.1 0.1 0.1"/></geometry></visual>';
  const ground = `<link name="ground"><visual><geometry><mesh filename="cube.obj" scale="0.2 0.2 0.02"/></geometry></visual></link>
    <joint name="stand" type="fixed"><parent link="base"/><child link="ground"/></joint></robot>`;
  writeFileSync(join(folder, "meshed.urdf"), arm.replaceAll("</inertial>", mesh).replace("</robot>", ground));
  const own = await Server.start(join(folder, "meshed.urdf"), "--port", "0");
  const there = await Session.start(own.url);
  try {
    const page = await there.page("show=none");
    await settled(page);
    const drawn = await inked(page);
    expect(drawn).toBeGreaterThan(500);
    await page.getByRole("checkbox", { name: "visuals of the file" }).uncheck();
    await page.waitForTimeout(600);
    expect(Math.abs((await inked(page)) / drawn - 1)).toBeGreaterThan(0.1);
    // One file, asked for once.
    const asked = await page.evaluate(() => performance.getEntriesByType("resource").filter(({ name }) => name.includes("/api/mesh/")).length);
    expect(asked).toBe(1);
    there.clean();
  } finally {
    await there.stop();
    own.stop();
  }
});

test("by touch: one finger moves a joint, two zoom", async () => {
  const touch = await Session.start(server.url, { hasTouch: true });
  try {
    const page = await touch.page("m=hydra(4,1,0,1)&q=0.3,0.3,0.3,0.3&show=skeleton&eye=0.4,0,14,2,0.5,0");
    await settled(page);
    const box = (await page.locator(".stage canvas").boundingBox())!;
    const at = await grabbable(page, box);
    await page.mouse.move(0, 0);
    const fingers = await touch.context.newCDPSession(page);
    const put = (type: "touchStart" | "touchMove" | "touchEnd", ...touchPoints: { x: number; y: number; id?: number }[]) => fingers.send("Input.dispatchTouchEvent", { type, touchPoints });
    await put("touchStart", at);
    for (let k = 1; k <= 8; k++) await put("touchMove", { x: at.x, y: at.y - 6 * k });
    await put("touchEnd");
    await agrees(page, "hydra(4,1,0,1)");
    expect(coordinates(page).filter((x) => x !== 0.3)).toHaveLength(1);

    const distance = () => Number(new URLSearchParams(new URL(page.url()).hash.slice(1)).get("eye")!.split(",")[2]);
    const middle = { x: box.x + box.width / 2, y: box.y + box.height - 40 };
    const pair = (apart: number) => [-apart, apart].map((x, id) => ({ x: middle.x + x, y: middle.y, id }));
    const before = distance();
    await put("touchStart", ...pair(30));
    for (let k = 1; k <= 6; k++) await put("touchMove", ...pair(30 + 5 * k));
    await put("touchEnd");
    await settled(page);
    // The fingers end twice as far apart.
    expect(distance() / before).toBeCloseTo(0.5, 1);
    touch.clean();
  } finally {
    await touch.stop();
  }
});

test("a check is cancelled, and the server stops", async () => {
  const page = await session.page("m=hydra(256,1.5,0.3,0.9)&tab=file");
  await settled(page);
  const [took, whole] = await cancelledCheck(page);
  console.log(`a small check after a large one that was cancelled: ${took.toFixed(0)} ms; the large one to its end: ${whole.toFixed(0)} ms`);
  expect(took).toBeLessThan(whole / 2);
  session.clean();
});

test("560 links stay live", async () => {
  const page = await session.page("m=hydra(560,1,0,1)", countPictures);
  await settled(page);
  const rounds = [await pace(page), await pace(page), await pace(page)];
  const best = (name: "updates" | "pictures") => Math.max(...rounds.map((one) => one[name]));
  const all = rounds.map(({ updates, pictures }) => `${updates.toFixed(1)} and ${pictures.toFixed(1)}`);
  console.log(`hydra(560,1,0,1), updates and pictures a second, three rounds: ${all.join("; ")}`);
  expect(best("updates")).toBeGreaterThan(0);
  expect(best("pictures")).toBeGreaterThan(0);
  await agrees(page, "hydra(560,1,0,1)");
  session.clean();
});

test("a point of figure 6 is a robot", async () => {
  const page = await session.page("tab=figures&figure=F-fig6");
  const points = page.locator(".plot .point");
  await points.first().waitFor();
  const point = page.getByRole("button", { name: /^(?:.*0(?:\.0+)?): .*N 10(?:\.0+)?,/ }).first();
  const named = (await point.getAttribute("aria-label"))!;
  await point.locator(".halo").click();
  await page.getByRole("heading", { level: 1, name: "hydra(10," }).waitFor();
  await settled(page);
  // Drawn to four digits.
  const drawn = Number(/κ ([\d.]+(?:e\d+)?)$/.exec(named)![1]);
  expect(Math.abs((await reading(page, "kappa")) / drawn - 1)).toBeLessThan(1e-3);
  await agrees(page, "hydra(10,1,0,1)");

  // By keyboard, the next point.
  await page.locator('.plot .point[aria-pressed="true"]').focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Enter");
  await expect.poll(() => page.getByRole("heading", { level: 1 }).textContent()).not.toContain("hydra(10,");
  session.clean();
});

test("a link holds the state", async () => {
  const page = await session.page();
  await settled(page);
  await drop(page, "arm.urdf", arm);
  await page.locator('.text li[data-line="18"] .note').waitFor();
  await page.getByRole("textbox", { name: "wrist (kg m²)" }).fill("0.02");
  await page.getByRole("textbox", { name: "wrist (kg m²)" }).press("Enter");
  await settled(page);
  await slide(page, "elbow", 0.7);
  await tab(page, "Line and map");
  await page.getByRole("button", { name: "A is here" }).click();
  await page.getByRole("radio", { name: "stiffest mode" }).check();
  await page.getByRole("checkbox", { name: "centres of mass" }).check();
  await page.locator(".stage canvas").focus();
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("+");
  // A pointer over a joint's slider lights the joint up; the focus frames the view.
  await page.mouse.move(0, 0);
  await page.evaluate(() => (document.activeElement as HTMLElement).blur());
  await settled(page);
  const [address, kappa] = [page.url(), await reading(page, "kappa")];

  const other = await session.page(new URL(address).hash.slice(1));
  await settled(other);
  expect(other.url()).toBe(address);
  expect(await reading(other, "kappa")).toBe(kappa);
  expect(await other.getByRole("heading", { level: 1 }).textContent()).toBe("arm.urdf");
  expect(await other.getByRole("tab", { selected: true }).textContent()).toBe("Line and map");
  expect(await other.getByRole("radio", { name: "stiffest mode" }).isChecked()).toBe(true);
  expect(await other.getByRole("checkbox", { name: "centres of mass" }).isChecked()).toBe(true);
  expect(coordinates(other)).toEqual(coordinates(page));
  const same = async () => {
    const shots = await Promise.all([page, other].map((one) => one.locator(".stage canvas").screenshot()));
    return shots[0]!.equals(shots[1]!);
  };
  // Edges are smoothed once nothing has moved for a while.
  await expect.poll(same, { timeout: 15_000 }).toBe(true);
  session.clean();
});

test("a link that makes no sense still shows a robot", async () => {
  const page = await session.page("m=hydra(no)&q=1,2&tab=figures");
  await page.getByRole("heading", { level: 1, name: "puma560" }).waitFor();
  expect(await page.getByRole("alert").textContent()).toContain("hydra");
  session.clean([/status of 422/]);
});

test("the map goes where it is pressed, and says κ of there", async () => {
  const page = await session.page("tab=line");
  await settled(page);
  const box = page.getByRole("application", { name: /^κ over/ });
  await box.scrollIntoViewIfNeeded();
  await box.focus();
  for (let k = 0; k < 5; k++) await page.keyboard.press("ArrowUp");
  for (let k = 0; k < 9; k++) await page.keyboard.press("ArrowRight");
  const readout = page.locator(".raster .readout:visible");
  const told = /κ = ([\d.e]+)/.exec((await readout.textContent())!)![1];
  await page.keyboard.press("Enter");
  await agrees(page, "puma560");
  expect((await reading(page, "kappa")).toPrecision(6)).toBe(Number(told).toPrecision(6));
  session.clean();
});

test("κ along a line is κ at its ends and on its way", async () => {
  const page = await session.page("tab=line");
  await settled(page);
  await page.getByRole("button", { name: "A is here" }).click();
  await page.getByRole("button", { name: "Random" }).click();
  await settled(page);
  await page.getByRole("button", { name: "B is here" }).click();
  const end = await reading(page, "kappa");
  await page.getByRole("slider", { name: "From A to B" }).press("Home");
  await page.getByRole("button", { name: "Go to A" }).click();
  await settled(page);
  expect(await reading(page, "kappa")).not.toBe(end);
  await page.getByRole("button", { name: "Go to B" }).click();
  await agrees(page, "puma560");
  expect(await reading(page, "kappa")).toBe(end);
  const label = await page.locator(".plot:visible svg").first().getAttribute("aria-label");
  expect(Number(/to ([\d.]+)$/.exec(label!)![1])).toBeCloseTo(end, 1);
  session.clean();
});

test("a family by its sliders, down to one link", async () => {
  const page = await session.page("tab=model&m=hydra(10,1,0,1)");
  await settled(page);
  const links = page.getByRole("slider", { name: /^N/ });
  await links.focus();
  await page.keyboard.press("End");
  await expect.poll(() => page.getByRole("heading", { level: 1 }).textContent(), { timeout: 20_000 }).not.toContain("hydra(10,");
  await page.keyboard.press("Home");
  await page.getByRole("heading", { level: 1, name: "hydra(1, 1, 0, 1)" }).waitFor();
  await agrees(page, "hydra(1,1,0,1)");
  expect(await reading(page, "kappa")).toBe(1);
  await page.getByRole("textbox", { name: "or typed" }).fill("onion(12,1.5,0.3,0.9)");
  await page.getByRole("button", { name: "Open this family" }).click();
  await page.getByRole("heading", { level: 1, name: "onion(12" }).waitFor();
  await page.getByRole("button", { name: "Zag" }).click();
  await agrees(page, "onion(12,1.5,0.3,0.9)");
  session.clean();
});

test("a humanoid: updates, base floating, base removed", async () => {
  const page = await session.page();
  await settled(page);
  await page.locator('header input[type="file"]').setInputFiles(g1());
  await page.getByRole("heading", { level: 1, name: /g1/ }).waitFor();
  await page.getByRole("button", { name: "Random" }).click();
  await agrees(page, g1());
  expect(await inked(page)).toBeGreaterThan(500);
  await tab(page, "Analysis");
  const times = await reactions(page);
  console.log(`G1: from slider to κ, spectrum and matrix: median ${times[20]!.toFixed(1)} ms, worst of 40 ${times.at(-1)!.toFixed(1)} ms`);
  expect(times).toHaveLength(40);
  await tab(page, "Robot");
  await page.getByRole("combobox", { name: "Base" }).selectOption("floating");
  await page.getByRole("checkbox", { name: "base removed" }).check();
  await page.locator("header").getByText("free-floating").waitFor();
  await agrees(page, g1(), "--base", "floating", "--reduced");
  session.clean();
});

test("a model that the server has let go comes back by itself", async () => {
  const page = await session.page();
  await settled(page);
  await page.evaluate(async () => {
    const token = document.querySelector<HTMLMetaElement>('meta[name="eigenbody-token"]')!.content;
    const headers = { "X-Eigenbody-Token": token, "Content-Type": "application/json" };
    for (let k = 0; k < 140; k++) {
      await fetch("/api/model", { method: "POST", headers, body: JSON.stringify({ source: { family: `hydra(${k + 2},1,0,1)` } }) });
    }
  });
  await slide(page, "joint_2", 0.7);
  await agrees(page, "puma560");
  session.clean([/status of 404/]);
});

test("a mode swings, and rests for those who want no motion", async () => {
  const page = await session.page("m=hydra(5,1,0,1)&swing=1");
  await settled(page);
  const shot = async (one: Page) => (await one.locator(".stage canvas").screenshot()).toString("base64");
  const first = await shot(page);
  await page.waitForTimeout(500);
  expect(await shot(page)).not.toBe(first);
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.reload();
  await settled(page);
  const calm = await shot(page);
  await page.waitForTimeout(500);
  expect(await shot(page)).toBe(calm);
  await page.getByRole("button", { name: "Swing" }).click();
  await page.getByRole("slider", { name: "along the mode" }).press("End");
  await page.waitForTimeout(300);
  expect(await shot(page)).not.toBe(calm);
  session.clean();
});

test("everything is reached by the keyboard, and the focus is seen", async () => {
  const page = await session.page("tab=analysis");
  await settled(page);
  const wanted = await page.evaluate(() =>
    [...document.querySelectorAll<HTMLElement>("button, select, input, [tabindex]")].filter((one) => one.checkVisibility() && one.tabIndex >= 0 && !(one as HTMLInputElement).disabled).length);
  const seen = new Set<string>();
  const unseen: string[] = [];
  for (let k = 0; k < wanted + 20; k++) {
    await page.keyboard.press("Tab");
    const now = await page.evaluate(() => {
      const one = document.activeElement as HTMLElement;
      if (one === document.body) return null;
      const all = [...document.querySelectorAll("*")];
      const shown = one.matches('input[type="file"]') ? one.closest("label")! : one;
      const { outlineStyle, outlineWidth } = getComputedStyle(shown);
      return { key: String(all.indexOf(one)), name: `${one.tagName} ${one.textContent.slice(0, 20)}`, visible: outlineStyle !== "none" && parseFloat(outlineWidth) >= 2 };
    });
    if (!now) continue;
    seen.add(now.key);
    if (!now.visible) unseen.push(now.name);
  }
  expect(unseen).toEqual([]);
  // Of a group of radio buttons one is in the order, the other is reached by arrow keys.
  expect(seen.size).toBeGreaterThanOrEqual(wanted - 1);

  const slider = page.getByRole("slider", { name: "joint_2", exact: true });
  await slider.focus();
  const before = await reading(page, "kappa");
  await page.keyboard.press("ArrowRight");
  await expect.poll(() => reading(page, "kappa")).not.toBe(before);
  await page.getByRole("tab", { selected: true }).focus();
  await page.keyboard.press("ArrowRight");
  expect(await page.getByRole("tab", { selected: true }).textContent()).toBe("Line and map");
  await page.keyboard.press("End");
  expect(await page.getByRole("tab", { selected: true }).textContent()).toBe("Figures");
  session.clean();
});

describe("widths", () => {
  test.each([["wide", { width: 1280, height: 800 }], ["narrow", NARROW]])("%s: nothing is wider than the window", async (_, viewport) => {
    const page = await session.page();
    await page.setViewportSize(viewport);
    for (const name of ["analysis", "line", "model", "file", "figures"]) {
      await page.goto("about:blank");
      await page.goto(`${server.url}#tab=${name}`);
      await settled(page);
      const [needs, has] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      expect([name, needs]).toEqual([name, has]);
    }
    expect(await inked(page)).toBeGreaterThan(300);
    session.clean();
  });
});

test("without WebGL the robot is drawn flat, and the page says so", async () => {
  const plain = await Session.start(server.url, {}, NO_WEBGL);
  try {
    const page = await plain.page();
    await settled(page);
    await page.getByText("no WebGL").waitFor();
    expect(await inked(page)).toBeGreaterThan(500);
    await slide(page, "joint_2", 0.8);
    await agrees(page, "puma560");
    plain.clean([/WebGL/i]);
  } finally {
    await plain.stop();
  }
});
