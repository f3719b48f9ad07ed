/** How fast the explorer answers, a line a figure into the file `FIGURES`: name, tab, number. */

import { appendFileSync } from "node:fs";
import { afterAll, afterEach, beforeAll, beforeEach, test } from "vitest";
import { g1, Server, Session, settled } from "./harness";
import { cancelledCheck, countPictures, pace, reactions } from "./pace";

const ROUNDS = 3;
const told = (name: string, x: number) => appendFileSync(process.env["FIGURES"]!, `${name}\t${x}\n`);

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

test("560 links", async () => {
  const page = await session.page("m=hydra(560,1,0,1)", countPictures);
  await settled(page);
  for (let k = 0; k < ROUNDS; k++) {
    const { updates, pictures } = await pace(page);
    told("updates", updates);
    told("pictures", pictures);
  }
});

test("a humanoid", async () => {
  const page = await session.page("tab=analysis");
  await settled(page);
  await page.locator('header input[type="file"]').setInputFiles(g1());
  await page.getByRole("heading", { level: 1, name: /g1/ }).waitFor();
  await settled(page);
  for (let k = 0; k < ROUNDS; k++) {
    const times = await reactions(page);
    told("reaction", times[times.length / 2]! / 1000);
    told("slowest reaction", times.at(-1)! / 1000);
  }
});

test("a cancelled check", async () => {
  const page = await session.page("m=hydra(256,1.5,0.3,0.9)&tab=file");
  await settled(page);
  const [small, large] = await cancelledCheck(page);
  told("after a cancelled check", small / 1000);
  told("check", large / 1000);
});
