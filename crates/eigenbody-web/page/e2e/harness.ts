/**
 * The real command and a real browser.
 *
 * | variable | what |
 * |---|---|
 * | `EIGENBODY` | the command; else `target/release/eigenbody` |
 * | `CHROMIUM` | the browser; else the first of the usual names on the path |
 * | `G1` | the URDF file of Unitree's G1 |
 * | `LIVE` | if set, the page's files come from dist/, not from the command: no build of the command while the page is written |
 */

import { execFileSync, spawn, type ChildProcess } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { chromium, type BrowserContext, type BrowserContextOptions, type Page } from "playwright-core";
import { expect } from "vitest";

const PAGE = resolve(import.meta.dirname, "..");
export const FIXTURES = join(PAGE, "e2e", "robots");

function needed(what: string, path: string | undefined): string {
  if (path && existsSync(path)) return path;
  throw new Error(`${what} is not there: run \`cargo xtask explorer\`, which prepares it`);
}

export function command(): string {
  return needed("the command eigenbody", process.env["EIGENBODY"] ?? resolve(PAGE, "../../../target/release/eigenbody"));
}

export function g1(): string {
  return needed("the robot file in G1", process.env["G1"]);
}

function browser(): string {
  const names = ["chromium", "chromium-browser", "google-chrome"];
  const found = (process.env["PATH"] ?? "").split(delimiter).flatMap((folder) => names.map((name) => join(folder, name)));
  return needed("Chromium", process.env["CHROMIUM"] ?? found.find(existsSync));
}

/** What a call of the command prints. */
export function said(...words: string[]): string {
  return execFileSync(command(), words, { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] });
}

/** A call whose status 1 (findings) is no failure. */
export function checked(...words: string[]): Record<string, unknown> {
  try {
    return JSON.parse(said(...words)) as Record<string, unknown>;
  } catch (error) {
    const { status, stdout } = error as { status?: number; stdout?: string };
    if (status !== 1 || !stdout) throw error;
    return JSON.parse(stdout) as Record<string, unknown>;
  }
}

export class Server {
  private constructor(
    readonly url: string,
    private readonly process: ChildProcess,
  ) {}

  static async start(...words: string[]): Promise<Server> {
    const child = spawn(command(), ["serve", ...words], { stdio: ["ignore", "pipe", "inherit"] });
    for await (const line of createInterface({ input: child.stdout! })) return new Server(line.trim(), child);
    throw new Error("`eigenbody serve` ended without an address");
  }

  stop(): void {
    this.process.kill("SIGTERM");
  }
}

const ARGUMENTS = [
  "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
];
/** WebGL by the processor, the same everywhere; the rest of the page as on any machine without a graphics processor. */
const SOFTWARE = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-rasterization", "--disable-gpu-compositing"];
export const NO_WEBGL = ["--disable-gpu", "--disable-3d-apis"];

export const WIDE = { width: 1280, height: 800 };
export const NARROW = { width: 390, height: 844 };

/** A browser without a past, and what it complained about. */
export class Session {
  readonly complaints: string[] = [];
  readonly foreign: string[] = [];

  private constructor(
    private readonly folder: string,
    readonly context: BrowserContext,
    private readonly home: string,
  ) {}

  static async start(home: string, options: BrowserContextOptions = {}, graphics: string[] = SOFTWARE): Promise<Session> {
    const folder = mkdtempSync(join(tmpdir(), "eigenbody-e2e-"));
    const context = await chromium.launchPersistentContext(folder, {
      executablePath: browser(), headless: true, args: [...ARGUMENTS, ...graphics], viewport: WIDE, acceptDownloads: true, ...options,
    });
    if (process.env["LIVE"]) {
      await context.route("**/assets/*", (route) => route.fulfill({ path: join(PAGE, "dist/assets", new URL(route.request().url()).pathname.split("/").at(-1)!) }));
    }
    return new Session(folder, context, home);
  }

  /** A page at a link; `before` runs in it before its own scripts. */
  async page(hash = "", before?: () => void): Promise<Page> {
    const page = await this.context.newPage();
    if (before) await page.addInitScript(before);
    // Without a graphics processor the driver remarks on how slow it is.
    const remark = /GL Driver Message \(OpenGL, Performance/;
    page.on("console", (message) => ["error", "warning"].includes(message.type()) && !remark.test(message.text()) && this.complaints.push(message.text()));
    page.on("pageerror", (error) => this.complaints.push(String(error)));
    page.on("request", (request) => {
      const { protocol, origin } = new URL(request.url());
      if (!["data:", "blob:"].includes(protocol) && origin !== new URL(this.home).origin) this.foreign.push(request.url());
    });
    await page.goto(this.home + (hash && `#${hash}`));
    return page;
  }

  /** Nothing on the console, nothing asked of anyone else. */
  clean(allowed: RegExp[] = []): void {
    expect(this.complaints.filter((text) => !allowed.some((one) => one.test(text)))).toEqual([]);
    expect(this.foreign).toEqual([]);
  }

  async stop(): Promise<void> {
    await this.context.close();
    rmSync(this.folder, { recursive: true, force: true, maxRetries: 5 });
  }
}

export type Reading = "kappa" | "kappa_weighted" | "lambda_min" | "lambda_max";

/** A number of the page, to the bit. */
export async function reading(page: Page, name: Reading): Promise<number> {
  const value = await page.locator(`[data-number="${name}"]`).getAttribute("value");
  return value ? Number(value) : Number.NaN;
}

/** Once the page has come to rest: the address says where the robot is, and the numbers are of there. */
export async function settled(page: Page): Promise<void> {
  await page.locator('[data-number="kappa"][value]').waitFor({ state: "attached" });
  await page.waitForLoadState("networkidle");
  await page.waitForTimeout(400);
  await page.waitForLoadState("networkidle");
}

/** The coordinates in the page's address. */
export function coordinates(page: Page): number[] {
  const q = new URLSearchParams(new URL(page.url()).hash.slice(1)).get("q");
  return (q ?? "").split(",").filter(Boolean).map(Number);
}

/** What `eigenbody spectrum` says; where an address has no coordinates, the robot is where it was at first. */
export function spectrum(model: string, q: readonly number[], ...more: string[]): Record<Reading, number> & { softest: { share: number[] } } {
  return JSON.parse(said("spectrum", model, "--at", q.length > 0 ? `q=[${q.join(",")}]` : "zero", "--json", ...more)) as never;
}

/** A file dropped on the page, as a file manager does it. */
export async function drop(page: Page, name: string, text: string): Promise<void> {
  const transfer = await page.evaluateHandle(([file, words]) => {
    const data = new DataTransfer();
    data.items.add(new File([words!], file!, { type: "application/xml" }));
    return data;
  }, [name, text]);
  await page.dispatchEvent("body", "dragover", { dataTransfer: transfer });
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
}

/** How many pixels of the view are neither its background nor floor: a robot is drawn there. */
export async function inked(page: Page): Promise<number> {
  const shot = (await page.locator(".stage canvas").screenshot()).toString("base64");
  return page.evaluate(async (data) => {
    const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
    const pen = new OffscreenCanvas(image.width, image.height).getContext("2d")!;
    pen.drawImage(image, 0, 0);
    const { data: pixels } = pen.getImageData(0, 0, image.width, image.height);
    const far = (k: number) => [0, 1, 2].reduce((sum, c) => sum + Math.abs(pixels[k + c]! - pixels[c]!), 0) > 120;
    let count = 0;
    for (let k = 0; k < pixels.length; k += 4) if (far(k)) count += 1;
    return count;
  }, shot);
}
