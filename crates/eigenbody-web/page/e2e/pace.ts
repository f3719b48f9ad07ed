/** How fast the explorer answers. */

import type { Page } from "playwright-core";

/** For a page before it loads: a picture is drawn when its canvas has been cleared for it. */
export function countPictures(): void {
  const { clear } = WebGL2RenderingContext.prototype;
  WebGL2RenderingContext.prototype.clear = function (mask) {
    document.documentElement.dataset["pictures"] = String(Number(document.documentElement.dataset["pictures"] ?? 0) + 1);
    clear.call(this, mask);
  };
}

/**
 * Updates and pictures a second while a slider goes to and fro for four seconds, as often as the page shows a frame. An update is an answer
 * of the server in the numbers on the page; pictures are those drawn in the same time, each of the newest answer.
 */
export function pace(page: Page): Promise<{ updates: number; pictures: number }> {
  return page.evaluate(async () => {
    const slider = document.querySelector<HTMLInputElement>('.joints input[type="range"]')!;
    const value = document.querySelector('[data-number="kappa"]')!;
    const pictures = () => Number(document.documentElement.dataset["pictures"]);
    let updates = 0;
    const watch = new MutationObserver(() => (updates += 1));
    watch.observe(value, { attributes: true, attributeFilter: ["value"] });
    const frame = () => new Promise((done) => requestAnimationFrame(done));
    const [start, before] = [performance.now(), pictures()];
    for (let k = 0; performance.now() - start < 4000; k++) {
      slider.value = String(Math.sin(k / 20));
      slider.dispatchEvent(new Event("input", { bubbles: true }));
      await frame();
    }
    watch.disconnect();
    const seconds = (performance.now() - start) / 1000;
    return { updates: updates / seconds, pictures: (pictures() - before) / seconds };
  });
}

/** From a slider to the numbers on the page, forty times, sorted (ms). */
export function reactions(page: Page): Promise<number[]> {
  return page.evaluate(async () => {
    const slider = document.querySelector<HTMLInputElement>('.joints input[type="range"]')!;
    const value = document.querySelector('[data-number="kappa"]')!;
    const took: number[] = [];
    for (let k = 0; k < 40; k++) {
      const start = performance.now();
      const told = new Promise((done) => {
        const watch = new MutationObserver(() => (watch.disconnect(), done(0)));
        watch.observe(value, { attributes: true });
      });
      slider.value = String(0.01 * (k + 1));
      slider.dispatchEvent(new Event("input", { bubbles: true }));
      await told;
      took.push(performance.now() - start);
    }
    return took.sort((a, b) => a - b);
  });
}

/**
 * A long check, of the model that the page shows, is cancelled: how long a small one takes then, and the long one to its end (ms). One check at
 * a time: another has its turn when the first has ended.
 */
export async function cancelledCheck(page: Page): Promise<[number, number]> {
  const check = page.getByRole("region", { name: "Check" });
  await check.getByRole("button", { name: /^Check all/ }).click();
  await check.getByText("Searching").waitFor();
  await page.waitForTimeout(500);
  await check.getByRole("button", { name: "Cancel the check" }).click();
  await check.getByText("Cancelled.").waitFor();
  return page.evaluate(async () => {
    const token = document.querySelector<HTMLMetaElement>('meta[name="eigenbody-token"]')!.content;
    const headers = { "X-Eigenbody-Token": token, "Content-Type": "application/json" };
    const post = async (path: string, body: object) => (await fetch(`/api/${path}`, { method: "POST", headers, body: JSON.stringify(body) })).json();
    const check = async (family: string, ask: object) => {
      const { id } = (await post("model", { source: { family } })) as { id: string };
      const start = performance.now();
      const { findings } = (await post("check", { id, ...ask })) as { findings: object[] };
      return [findings.length, performance.now() - start] as const;
    };
    const [none, small] = await check("hydra(3,1,0,1)", { samples: 64 });
    const [some, large] = await check("hydra(256,1.5,0.3,0.9)", {});
    return none === 0 && some > 0 ? [small, large] : [Number.NaN, Number.NaN];
  });
}
