/** From numbers to places along an axis, and the ticks there. */

import { significant } from "../math/number";

export interface Tick {
  value: number;
  label: string;
}

export interface Scale {
  at(x: number): number;
  back(place: number): number;
  ticks: Tick[];
}

export interface Extent {
  low: number;
  high: number;
}

/** What the numbers span; on a logarithmic axis only those above zero count. None if there are none. */
export function extent(values: Iterable<number | null>, log: boolean): Extent | null {
  let [low, high] = [Infinity, -Infinity];
  for (const x of values) {
    if (x === null || !Number.isFinite(x) || (log && x <= 0)) continue;
    low = Math.min(low, x);
    high = Math.max(high, x);
  }
  return low <= high ? { low, high } : null;
}

/** A scale from `from` to `to` (px), a little wider than the numbers. */
export function scale({ low, high }: Extent, log: boolean, from: number, to: number, most = 6): Scale {
  return log ? logScale(low, high, from, to, most) : linearScale(low, high, from, to, most);
}

function linearScale(low: number, high: number, from: number, to: number, most: number): Scale {
  if (low === high) [low, high] = [low - Math.max(1e-12, Math.abs(low) / 10), high + Math.max(1e-12, Math.abs(high) / 10)];
  const step = niceStep((high - low) / most);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  const ticks = Array.from({ length: Math.max(0, last - first + 1) }, (_, k) => (first + k) * step).map((value) => ({ value, label: plain(value, step) }));
  const rate = (to - from) / (high - low);
  return { at: (x) => from + (x - low) * rate, back: (place) => low + (place - from) / rate, ticks };
}

function logScale(low: number, high: number, from: number, to: number, most: number): Scale {
  let [a, b] = [Math.log10(low), Math.log10(high)];
  // Less than a decade says more with its neighbours.
  if (b - a < 1) [a, b] = [(a + b) / 2 - 0.5, (a + b) / 2 + 0.5];
  const rate = (to - from) / (b - a);
  const every = Math.max(1, Math.ceil((b - a) / most));
  const decades = Array.from({ length: Math.floor(b + 1e-9) - Math.ceil(a - 1e-9) + 1 }, (_, k) => Math.ceil(a - 1e-9) + k).filter((d) => d % every === 0);
  const between = decades.length >= 3 ? [1] : [1, 2, 5];
  const fine = decades.length >= 3 ? decades : Array.from({ length: Math.floor(b) - Math.floor(a) + 1 }, (_, k) => Math.floor(a) + k);
  const ticks = fine.flatMap((d) => between.map((m) => m * 10 ** d)).filter((x) => Math.log10(x) >= a - 1e-9 && Math.log10(x) <= b + 1e-9);
  return {
    at: (x) => from + (Math.log10(x) - a) * rate,
    back: (place) => 10 ** (a + (place - from) / rate),
    ticks: ticks.map((value) => ({ value, label: power(value) })),
  };
}

function niceStep(rough: number): number {
  const decade = 10 ** Math.floor(Math.log10(rough));
  return decade * ([1, 2, 5].find((m) => m * decade >= 0.8 * rough) ?? 10);
}

function plain(value: number, step: number): string {
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  if (decimals > 4 || Math.abs(value) >= 1e6) return significant(value, 2).replaceAll("-", "−");
  return (value === 0 ? 0 : value).toFixed(decimals).replace("-", "−");
}

const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** Powers of ten with raised exponents; what is near one as it is. */
export function power(x: number): string {
  if (x >= 0.0099 && x < 9999) return String(Number(x.toPrecision(3)));
  const exponent = Math.floor(Math.log10(x) + 1e-9);
  const head = Math.round(x / 10 ** exponent);
  const raised = [...String(Math.abs(exponent))].map((digit) => RAISED[Number(digit)]).join("");
  return `${head === 1 ? "" : `${head}·`}10${exponent < 0 ? "⁻" : ""}${raised}`;
}
