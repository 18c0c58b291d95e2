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

  /** Down a tree of bits to its leaves; a byte `other` tells which way it went, as long as that is right. */
  const tree = (k: number, leaves: number, other = 0, guided = 0): number => {
    // In variables of its own, which is where the time goes.
    let range = now[0]!;
    let code = now[1]!;
    let node = 1;
    while (node < leaves) {
      other <<= 1;
      const guess = other & guided;
      const place = k + guided + guess + node;
      const chance = chances[place]!;
      const bound = (range >>> 11) * chance;
      if (code < bound) {
        range = bound;
        chances[place] = chance + ((2048 - chance) >> 5);
        node <<= 1;
        guided &= ~guess;
      } else {
        range -= bound;
        code -= bound;
        chances[place] = chance - (chance >> 5);
        node = (node << 1) | 1;
        guided &= guess;
      }
      if (range < 0x1000000) {
        range = (range << 8) >>> 0;
        code = ((code << 8) | packed[from++]!) >>> 0;
      }
    }
    now[0] = range;
    now[1] = code;
    return node - leaves;
  };
  const bit = (k: number): number => tree(k - 1, 2);
  const number = (k: number, bits: number): number => tree(k, 1 << bits);
  /** The lowest bit first. */
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
      if (now[0]! >= 0x1000000) continue;
      now[0]! <<= 8;
      now[1] = (now[1]! << 8) | packed[from++]!;
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
      // Behind a piece, the byte that would have gone on with it tells something.
      result[at] = state < 7 ? tree(k, 256) : tree(k, 256, result[at - back[0]! - 1]!, 256);
      ++at;
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
