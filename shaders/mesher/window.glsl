// Fills the window of tape.glsl from an item's list: as much of it as finds room.

const uint kEndOfWindow = 0xFFu;

// Loads entries from `from` on, up to `end`; returns the first that found no room.
uint fillWindow(uint from, uint end) {
  uint lane = gl_SubgroupInvocationID & 7u;
  uint filled = 0u;
  uint at = from;
  do {
    uint entry = scratch[at];
    uint place = (entry & 0x3FFFFFFFu) * 8u;
    uint choice = entry >> 30;
    uvec4 words = batch_fours[place + lane];
    uint head = subgroupShuffle(words.x, 0u), slots_word = subgroupShuffle(words.y, 0u);
    uint pieces = head >> 16, kind = head & 0xFFu;
    bool fits = filled + pieces + 1u < kWindow && at < end;
    bool alone_left = choice != kKept && kind < kOpCount;
    uint alone = choice == kFirstAlone ? slots_word >> 8 & 0xFFu : slots_word >> 16 & 0xFFu;
    // A minimum of one operand with itself is that operand, and stays in the row of minima that it stands in; others
    // become copies.
    bool copies = alone_left && kind != kOp_minimum && kind != kOp_maximum;
    if (alone_left && lane == 0u) {
      words.x = copies ? kOp_copy | 1u << 16 : words.x;
      words.y = (slots_word & 0xFFu) | alone << 8 | alone << 16;
    }
    // The ninth word is a fold's flags.
    if (choice == kFirstAlone && kind >= kOpCount && lane == 2u) words.x &= ~2u;
    if (copies) pieces = 1u;
    if (fits) window[filled] = words;
    uint piece = 1u;
    while (piece < pieces && fits) {
      window[filled + piece] = batch_fours[place + 8u * piece + lane];
      ++piece;
    }
    filled += fits ? pieces : 0u;
    at += fits ? 1u : 0u;
    if (!fits) break;
  } while (at < end);
  window[filled] = uvec4(kEndOfWindow);
  return at;
}
