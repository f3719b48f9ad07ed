/** The pictures of the guide: docs/guide/src/images. `SHOTS` names another folder. */

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, test } from "vitest";
import { command, drop, FIXTURES, g1, NARROW, Server, Session, settled } from "./harness";

const folder = process.env["SHOTS"] ?? resolve(import.meta.dirname, "../../../../docs/guide/src/images");

let server: Server;
beforeAll(async () => {
  mkdirSync(folder, { recursive: true });
  server = await Server.start("puma560", "--port", "0");
});
afterAll(() => server.stop());

interface Shot {
  /** What is done first. */
  prepare?: (page: Page) => Promise<void>;
  /** The same on a telephone, after this. */
  narrow?: (page: Page) => Promise<void>;
  colorScheme?: "light" | "dark";
}

async function shoot(name: string, hash: string, { prepare, narrow, colorScheme = "light" }: Shot): Promise<void> {
  const session = await Session.start(server.url, { colorScheme });
  try {
    const page = await session.page(hash);
    await settled(page);
    await prepare?.(page);
    await settled(page);
    await page.screenshot({ path: join(folder, `${name}.png`) });
    if (!narrow) return;
    await page.setViewportSize(NARROW);
    await page.reload();
    await settled(page);
    await narrow(page);
    await page.screenshot({ path: join(folder, `${name}-390.png`) });
  } finally {
    await session.stop();
  }
}

test("arm", () => shoot("explorer-arm", "q=0.4,-0.7,0.5,0.3,0.6,0&show=arrows,axes,centres,floor,skeleton", { narrow: async () => {} }));

test("arm, dark", () => shoot("explorer-dark", "q=0.4,-0.7,0.5,0.3,0.6,0&tab=line&mode=stiffest", { colorScheme: "dark", prepare: async (page) => {
  await page.getByRole("button", { name: "A is here" }).click();
  await page.getByRole("button", { name: "Random" }).click();
} }));

test("humanoid", () => shoot("explorer-humanoid", "colours=1", { prepare: async (page) => {
  await page.locator('header input[type="file"]').setInputFiles(g1());
  await page.getByRole("heading", { level: 1, name: /g1/ }).waitFor();
  await page.getByRole("tab", { name: "Analysis" }).click();
} }));

test("family", () => shoot("explorer-family", "tab=figures&figure=F-fig9", { prepare: async (page) => {
  await page.locator(".plot .point").first().waitFor();
  const points = page.getByRole("button", { name: / N [2-6]\d,/ });
  await points.nth(Math.floor((await points.count()) / 2)).locator(".halo").click();
  await settled(page);
} }));

test("fault", () => shoot("explorer-fault", "tab=file", {
  prepare: async (page) => {
    await drop(page, "arm.urdf", readFileSync(join(FIXTURES, "arm.urdf"), "utf8"));
    await page.locator(".text .note").first().waitFor();
  },
  narrow: (page) => page.getByRole("tablist").evaluate((bar) => bar.scrollIntoView()),
}));

test("report", async () => {
  const file = join(mkdtempSync(join(tmpdir(), "eigenbody-shots-")), "g1.html");
  // By its own name, whatever folder it is in.
  execFileSync(command(), ["report", basename(g1()), "-o", file], { cwd: dirname(g1()), stdio: "ignore" });
  const session = await Session.start(pathToFileURL(file).href, { colorScheme: "light" });
  try {
    const page = await session.page();
    await page.setViewportSize({ width: 820, height: 800 });
    // Down to the first robot.
    const { y, height } = (await page.locator("figure").first().boundingBox())!;
    await page.screenshot({ path: join(folder, "report.png"), fullPage: true, clip: { x: 0, y: 0, width: 820, height: y + height } });
  } finally {
    await session.stop();
  }
});
