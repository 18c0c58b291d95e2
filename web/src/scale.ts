// Round numbers on logarithmic scales.

/** Some round numbers between two positive ones, evenly spread by their factors. */
export function rounds(low: number, high: number): number[] {
  for (const digits of [[1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8], [1, 1.5, 2, 3, 5, 7], [1, 2, 5], [1]]) {
    const found = between(low, high, digits);
    if (found.length >= 3 && found.length <= 9) return found;
  }
  // Nearly equal: even steps.
  const rough = (high - low) / 4.01;
  const unit = 10 ** Math.floor(Math.log10(rough));
  const step = unit * ([1, 2, 5, 10].find((k) => k * unit >= rough) ?? 10);
  const first = Math.floor(low / step) + 1;
  return Array.from({ length: 16 }, (_, k) => (first + k) * step).filter((value) => value < high);
}

function between(low: number, high: number, digits: number[]): number[] {
  const found: number[] = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power)
    for (const digit of digits) found.push(digit * 10 ** power);
  return found.filter((value) => value > low && value < high);
}
