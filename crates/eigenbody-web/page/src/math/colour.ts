/** Colour scales that read the same with and without colour blindness. */

export type Rgb = [number, number, number];

/** Cividis (Nuñez, Anderton & Renslow 2018), from none to all; the scale of the report's matrices. */
const CIVIDIS: readonly Rgb[] = [
  [0, 34, 78], [18, 53, 112], [59, 73, 108], [87, 93, 109], [112, 113, 115], [138, 134, 120], [165, 156, 116], [205, 190, 98], [254, 232, 56],
];

/** The colour of a number from 0 to 1; what lies outside takes the end's. */
export function cividis(x: number): Rgb {
  const at = Math.min(1, Math.max(0, x)) * (CIVIDIS.length - 1);
  const k = Math.min(CIVIDIS.length - 2, Math.floor(at));
  const [a, b] = [CIVIDIS[k]!, CIVIDIS[k + 1]!];
  const part = at - k;
  return [0, 1, 2].map((c) => Math.round(a[c]! + part * (b[c]! - a[c]!))) as Rgb;
}

export function css([r, g, b]: Rgb): string {
  return `rgb(${r} ${g} ${b})`;
}

/** The place of x between two numbers, logarithmically; for x of the same sign as both. */
export function logPlace(x: number, low: number, high: number): number {
  return high > low ? Math.log(x / low) / Math.log(high / low) : 1;
}

/** A colour between two, `0xrrggbb`. */
export function mixed(a: number, b: number, part: number): number {
  const channel = (shift: number) => Math.round(((a >> shift) & 255) * (1 - part) + ((b >> shift) & 255) * part) << shift;
  return channel(16) | channel(8) | channel(0);
}

/** `#rrggbb` or `#rgb` as a number. */
export function hex(text: string): number {
  const digits = text.trim().replace("#", "");
  const long = digits.length === 3 ? [...digits].map((d) => d + d).join("") : digits;
  return Number.parseInt(long, 16);
}
