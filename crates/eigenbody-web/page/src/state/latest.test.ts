import { expect, test } from "vitest";
import { Latest } from "./latest";

/** A server that answers when told to. */
function slow() {
  const asked: number[] = [];
  const answers: ((ok: boolean) => void)[] = [];
  const ask = (x: number) => {
    asked.push(x);
    return new Promise<number>((resolve, reject) => answers.push((ok) => (ok ? resolve(10 * x) : reject(new Error("no")))));
  };
  const tick = async (ok = true) => {
    answers.shift()?.(ok);
    await new Promise((done) => setTimeout(done));
  };
  return { asked, ask, tick };
}

test("one question at a time, the newest next", async () => {
  const server = slow();
  const heard: [number, boolean][] = [];
  const latest = new Latest(server.ask, (answer, _, newest) => heard.push([answer, newest]), () => {});
  [1, 2, 3, 4].forEach((x) => latest.put(x));
  expect(server.asked).toEqual([1]);
  await server.tick();
  expect([server.asked, latest.busy]).toEqual([[1, 4], true]);
  await server.tick();
  expect([heard, latest.busy]).toEqual([[[10, false], [40, true]], false]);
});

test("a failure stops nothing", async () => {
  const server = slow();
  const heard: (number | string)[] = [];
  const latest = new Latest(server.ask, (answer) => heard.push(answer), (error) => heard.push(String(error)));
  latest.put(1);
  latest.put(2);
  await server.tick(false);
  await server.tick();
  expect(heard).toEqual(["Error: no", 20]);
});
