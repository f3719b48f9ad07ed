/** Numbers for people, written as the command line writes them. */

/**
 * A number with so many significant digits: plain between 1e-4 and 1e7, scientific outside.
 *
 * Rounds half to even where the number is exactly half way, as the command line does.
 */
export function significant(x: number, digits: number): string {
  const magnitude = Math.abs(x);
  if (x === 0) return "0";
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "–" : x < 0 ? "-∞" : "∞";
  if (magnitude < 1e-4 || magnitude >= 1e7) return x.toExponential(digits - 1).replace("e+", "e");
  const before = Math.floor(Math.log10(magnitude)) + 1;
  return fixed(x, Math.max(0, digits - before));
}

/** toFixed with ties to even. */
function fixed(x: number, decimals: number): string {
  const exact = Math.abs(x).toFixed(Math.min(100, decimals + 60));
  const cut = exact.length - 60;
  if (decimals > 40 || !/^50*$/.test(exact.slice(cut))) return x.toFixed(decimals);
  const kept = exact.slice(0, cut).replace(/\.$/, "");
  const even = "02468".includes(kept.at(-1) ?? "");
  return even ? (x < 0 ? `-${kept}` : kept) : x.toFixed(decimals);
}

/** The same with a true minus sign; a dash where there is no number. */
export function shown(x: number | null | undefined, digits = 6): string {
  return x === null || x === undefined ? "–" : significant(x, digits).replaceAll("-", "−");
}

/** An error estimate: one digit, `5e−14`. */
export function estimate(x: number | null | undefined): string {
  return x === null || x === undefined ? "" : x.toExponential(0).replace("e+", "e").replace("-", "−");
}

/** A number that someone typed; also multiples of π such as `pi/2` or `-3pi/4`. None if it is not one. */
export function typed(text: string): number | null {
  const clean = text.trim().replaceAll("−", "-").replaceAll("π", "pi").replace(",", ".");
  const found = /^([+-]?)(\d*\.?\d*(?:e[+-]?\d+)?)\s*\*?\s*(pi)?\s*(?:\/\s*(\d*\.?\d+))?$/i.exec(clean);
  if (!found || (!found[2] && !found[3])) return null;
  const [, sign, head, pi, below] = found;
  const value = (head ? Number(head) : 1) * (pi ? Math.PI : 1) / (below ? Number(below) : 1);
  return Number.isFinite(value) ? (sign === "-" ? -value : value) : null;
}
