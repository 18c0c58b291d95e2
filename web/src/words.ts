// Numbers and lists in words: as the command line writes them.

/** How many decimals show four digits of the largest number. */
function decimalsFor(largest: number): number {
  if (!(largest > 0)) return 0;
  return Math.min(Math.max(3 - Math.floor(Math.log10(largest * 1.00005)), 0), 9);
}

export function fixed(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  return /^-[0.]*$/.test(text) ? text.slice(1) : text;
}

/** With four digits; what is less than the last of nine decimals is 0. */
export const plain = (value: number) => (Math.abs(value) < 5e-10 ? '0' : fixed(value, decimalsFor(Math.abs(value))));
export const newtons = (force: number) => `${plain(force)} N`;
export const degrees = (angle: number) => `${fixed(angle, 2)}°`;
export const percent = (part: number) => `${fixed(100 * part, 1)} %`;

export function list(words: string[]): string {
  return words.length < 2 ? words.join('') : `${words.slice(0, -1).join(', ')} and ${words.at(-1)}`;
}

/** A turn between two postures, the shorter way. */
export function turn(from: number, to: number): string {
  const by = wrapped(to - from);
  return `${degrees(Math.abs(by))} ${by < 0 ? 'clockwise' : 'counter-clockwise'}`;
}

/** An angle in (-180, 180]. */
export function wrapped(angle: number): number {
  const rest = angle - 360 * Math.round(angle / 360);
  return rest <= -180 ? rest + 360 : rest;
}
