/** The committed bundle is what the sources build. */

import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { build } from "vite";
import { expect, test } from "vitest";

const page = resolve(import.meta.dirname, "..");

function files(folder: string): Record<string, string> {
  const names = readdirSync(folder, { recursive: true, encoding: "utf8" }).filter((name) => statSync(join(folder, name)).isFile()).sort();
  return Object.fromEntries(names.map((name) => [name, readFileSync(join(folder, name), "utf8")]));
}

test("dist/ is up to date: else `npm run build`, and commit it", async () => {
  const outDir = mkdtempSync(join(tmpdir(), "eigenbody-e2e-"));
  try {
    await build({ root: page, configFile: join(page, "vite.config.ts"), logLevel: "error", build: { outDir, emptyOutDir: true } });
    const [made, committed] = [files(outDir), files(join(page, "dist"))];
    expect(Object.keys(committed)).toEqual(Object.keys(made));
    for (const [name, text] of Object.entries(made)) expect([name, committed[name] === text]).toEqual([name, true]);
  } finally {
    rmSync(outDir, { recursive: true });
  }
});

test("the page takes less than a megabyte", () => {
  const total = Object.values(files(join(page, "dist"))).reduce((sum, text) => sum + Buffer.byteLength(text), 0);
  console.log(`dist/: ${(total / 1000).toFixed(0)} kB`);
  expect(total).toBeLessThan(1_000_000);
});
