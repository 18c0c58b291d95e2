// LZMA as `xz --format=lzma` packs it, to unpack the core: a range decoder whose probabilities adapt,
// and what it decodes: literals, and pieces of what came before.

/** `size` bytes. */
export function unpacked(packed: Uint8Array, size: number): Uint8Array<ArrayBuffer> {
  const result = new Uint8Array(size);
  const lc = packed[0]! % 9;
  const lp = Math.floor(packed[0]! / 9) % 5;
  const pb = Math.floor(packed[0]! / 45);
  // Behind the header and a 0.
  let from = 14;
  // The range and the code within it, of 32 bits without a sign.
  const now = Uint32Array.of(0xffffffff, 0);
  for (let k = 0; k < 4; ++k) now[1] = (now[1]! << 8) | packed[from++]!;

  /** The probability, of 2048, that a bit is 0: all in one row. */
  let room = 0;
  const place = (count: number) => (room += count) - count;
  const [isMatch, isRep, isOlder, isShort] = [place(192), place(12), place(36), place(192)];
  const [slots, distances, align, literals] = [place(256), place(128), place(16), place(768 << (lc + lp))];
  const [lengths, repLengths] = [place(514), place(514)];
  const chances = new Uint16Array(room).fill(1024);

  const more = () => {
    if (now[0]! >= 0x1000000) return;
    now[0]! <<= 8;
    now[1] = (now[1]! << 8) | packed[from++]!;
  };
  const bit = (k: number): number => {
    const chance = chances[k]!;
    const bound = (now[0]! >>> 11) * chance;
    const one = now[1]! < bound ? 0 : 1;
    if (one) {
      now[0]! -= bound;
      now[1]! -= bound;
      chances[k] = chance - (chance >> 5);
    } else {
      now[0] = bound;
      chances[k] = chance + ((2048 - chance) >> 5);
    }
    more();
    return one;
  };
  /** A number of so many bits, the highest first. */
  const number = (k: number, bits: number): number => {
    let node = 1;
    for (let n = 0; n < bits; ++n) node = (node << 1) | bit(k + node);
    return node - (1 << bits);
  };
  /** The lowest first. */
  const reversed = (k: number, bits: number): number => {
    let [node, value] = [1, 0];
    for (let n = 0; n < bits; ++n) {
      const one = bit(k + node);
      node = (node << 1) | one;
      value |= one << n;
    }
    return value;
  };
  const length = (k: number, aligned: number): number => {
    if (!bit(k)) return 2 + number(k + 2 + (aligned << 3), 3);
    if (!bit(k + 1)) return 10 + number(k + 130 + (aligned << 3), 3);
    return 18 + number(k + 258, 8);
  };
  const distance = (long: number): number => {
    const slot = number(slots + (Math.min(long - 2, 3) << 6), 6);
    if (slot < 4) return slot;
    const bits = (slot >> 1) - 1;
    const high = (2 | (slot & 1)) << bits;
    if (slot < 14) return high + reversed(distances + high - slot, bits);
    let middle = 0;
    for (let n = 4; n < bits; ++n) {
      now[0]! >>>= 1;
      const one = now[1]! >= now[0]! ? 1 : 0;
      now[1]! -= one * now[0]!;
      middle = (middle << 1) | one;
      more();
    }
    return high + (middle << 4) + reversed(align, 4);
  };

  // How far back the last four pieces began.
  let back = [0, 0, 0, 0];
  let state = 0;
  for (let at = 0; at < size; ) {
    const aligned = at & ((1 << pb) - 1);
    if (!bit(isMatch + (state << 4) + aligned)) {
      const before = at ? result[at - 1]! : 0;
      const k = literals + 768 * (((at & ((1 << lp) - 1)) << lc) + (before >> (8 - lc)));
      let node = 1;
      if (state >= 7) {
        // Behind a piece, the byte that would have gone on with it tells something.
        for (let other = result[at - back[0]! - 1]!, same = 1; node < 256; other <<= 1) {
          const guess = (other >> 7) & 1;
          const one = bit(k + node + (same ? (1 + guess) << 8 : 0));
          node = (node << 1) | one;
          if (one !== guess) same = 0;
        }
      } else while (node < 256) node = (node << 1) | bit(k + node);
      result[at++] = node;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let long: number;
    if (!bit(isRep + state)) {
      long = length(lengths, aligned);
      back = [distance(long), back[0]!, back[1]!, back[2]!];
      state = state < 7 ? 7 : 10;
    } else {
      const older = bit(isOlder + state) ? (bit(isOlder + 12 + state) ? 2 + bit(isOlder + 24 + state) : 1) : 0;
      if (!older && !bit(isShort + (state << 4) + aligned)) {
        long = 1;
        state = state < 7 ? 9 : 11;
      } else {
        back = [back[older]!, ...back.filter((_, k) => k !== older)];
        long = length(repLengths, aligned);
        state = state < 7 ? 8 : 11;
      }
    }
    for (const end = Math.min(at + long, size); at < end; ++at) result[at] = result[at - back[0]! - 1]!;
  }
  return result;
}
