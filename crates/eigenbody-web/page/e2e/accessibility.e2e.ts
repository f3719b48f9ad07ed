/** axe-core on every view, light and dark, wide and narrow, and on the report. */

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { mkdtempSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { checked, drop, FIXTURES, g1, NARROW, said, Server, Session, settled, WIDE } from "./harness";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

interface Violation {
  id: string;
  impact: string;
  nodes: { html: string; failureSummary: string }[];
}

/** What axe-core finds of weight. Evaluated by the debugger, which the page's policy does not bind. */
async function faults(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  const violations = await page.evaluate(async () => {
    const { axe: runner } = globalThis as unknown as { axe: { run(options: object): Promise<{ violations: Violation[] }> } };
    return (await runner.run({ resultTypes: ["violations"] })).violations;
  });
  const grave = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
  return grave.map(({ id, impact, nodes }) => `${impact} ${id}: ${nodes.slice(0, 3).map((node) => `${node.html.slice(0, 160)} (${node.failureSummary.replaceAll("\n", " ").slice(0, 240)})`).join("; ")}`);
}

const SCHEMES = ["light", "dark"] as const;
const VIEWS: [string, string][] = [
  ["arm", ""],
  ["arm, line and map", "tab=line"],
  ["family", "m=hydra(20,1.5,0.3,0.9)&tab=model&colours=1"],
  ["figures", "tab=figures&figure=F-fig6"],
];

describe.each(SCHEMES)("%s", (colorScheme) => {
  let server: Server;
  let session: Session;
  beforeAll(async () => {
    server = await Server.start("puma560", "--port", "0");
    session = await Session.start(server.url, { colorScheme });
  });
  afterAll(async () => {
    await session.stop();
    server.stop();
  });

  test.each(VIEWS.flatMap(([name, hash]) => [WIDE, NARROW].map((size) => [name, size.width, hash, size] as const)))("%s at %i px", async (_, _width, hash, size) => {
    const page = await session.page(hash);
    await page.setViewportSize(size);
    await settled(page);
    expect(await faults(page)).toEqual([]);
    await page.close();
  });

  test.each(["arm.urdf", "broken.urdf"])("fault: %s", async (name) => {
    const page = await session.page("tab=file");
    await settled(page);
    await drop(page, name, readFileSync(join(FIXTURES, name), "utf8"));
    await page.locator(".text .note").first().waitFor();
    expect(await faults(page)).toEqual([]);
    await page.close();
  });
});

describe("report of G1", () => {
  const file = join(mkdtempSync(join(tmpdir(), "eigenbody-e2e-")), "g1.html");
  beforeAll(() => {
    said("report", g1(), "-o", file);
  });

  test("is under 3 MB", () => expect(statSync(file).size).toBeLessThan(3_000_000));

  test.each(SCHEMES)("opens with the network off, %s, and nothing grave is found", async (colorScheme) => {
    // Scripts of the test, not of the page: its policy forbids any.
    const session = await Session.start(pathToFileURL(file).href, { colorScheme, bypassCSP: true });
    try {
      await session.context.setOffline(true);
      for (const size of [WIDE, NARROW]) {
        const page = await session.page();
        await page.setViewportSize(size);
        await page.getByRole("heading", { level: 1 }).waitFor();
        expect(await faults(page)).toEqual([]);
        const [needs, has] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
        expect(needs).toBeLessThanOrEqual(has!);
      }
      expect(session.complaints).toEqual([]);
      expect(session.foreign).toEqual([]);
    } finally {
      await session.stop();
    }
  });

  test("has the numbers of `check --format json`", async () => {
    const { worst } = checked("check", g1(), "--format", "json") as { worst: { measure: string; worst: number; median: number }[] };
    const session = await Session.start(pathToFileURL(file).href);
    try {
      const page = await session.page();
      for (const { measure, ...numbers } of worst) {
        for (const what of ["worst", "median"] as const) {
          const value = await page.locator(`#${measure}-${what}`).getAttribute("value");
          expect([measure, what, Number(value)]).toEqual([measure, what, numbers[what]]);
        }
      }
    } finally {
      await session.stop();
    }
  });
});
