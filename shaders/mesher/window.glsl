// Fills the window of tape.glsl with the records of an item's list, as far as they fit.

const uint kEndOfWindow = 0xFFu;

// Loads the records of the list's entries from..end into the window. Returns the first entry whose record did not fit.
// Each round reads one piece of a record, 32 words. Entries are read eight at a time, one per lane.
uint fillWindow(uint from, uint end) {
  const uint lane = gl_SubgroupInvocationID & 7u;
  uint filled = 0u, at = from, base = from, piece = 0u, pieces = 1u;
  bool fits = from < end;
  do {
    const uint entries = scratch[base + lane];
    do {
      const uint entry = fits ? subgroupShuffle(entries, at - base) : 0u;
      const uint choice = entry >> 30;
      uvec4 words = batch_fours[((entry & 0x3FFFFFFFu) + piece) * 8u + lane];
      const uint head = subgroupShuffle(words.x, 0u), slots_word = subgroupShuffle(words.y, 0u), kind = head & 0xFFu;
      const bool first = piece == 0u;
      const bool alone_left = first && choice != kKept && kind < kOpCount;
      const uint alone = choice == kFirstAlone ? slots_word >> 8 & 0xFFu : slots_word >> 16 & 0xFFu;
      // Pruning can reduce a record to one operand. If the record is a minimum or a maximum, it keeps its kind and
      // takes this operand twice, so that a series of equal ops is not interrupted. If the record unites a shape with
      // an operand that pruning has removed, the far slot (a constant far value) replaces that operand. All other
      // reduced records become copies.
      const bool unites = kind < kFirstJoin && choice == kSecondAlone;
      const bool copies = alone_left && kind != kOp_minimum && kind != kOp_maximum && !unites;
      if (alone_left && lane == 0u) {
        words.x = copies ? kOp_copy | 1u << 16 : words.x;
        words.y = (slots_word & 0xFFu) | alone << 8 | alone << 16;
      }
      // A record of a fold (items.glsl) has, in its ninth word, a flag that requests the test of the influence box.
      // Clears this flag if pruning has shown that the test is not needed (choice kFirstAlone).
      if (first && choice == kFirstAlone && kind >= kOpCount && lane == 2u) words.x &= ~2u;
      if (first) pieces = copies ? 1u : head >> 16;
      fits = fits && (!first || filled + pieces + 1u < kWindow);
      if (fits) window[filled] = words;
      filled += fits ? 1u : 0u;
      piece = piece + 1u < pieces ? piece + 1u : 0u;
      at += fits && piece == 0u ? 1u : 0u;
    } while (fits && at < min(base + 8u, end));
    base += 8u;
  } while (fits && at < end);
  window[filled] = uvec4(kEndOfWindow);
  return at;
}
