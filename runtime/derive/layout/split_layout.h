#pragma once
// Divides a length among the parts of a split. After CGA (Mueller, Wonka, Haegler, Ulmer, Van Gool, Procedural Modeling
// of Buildings, SIGGRAPH 2006, section 3).
//
// Rigid parts have exactly their length. The group of repeated parts is repeated as often as it fits beside the other
// parts, with flexible parts at their preferred lengths. If the group contains flexible parts, which can stretch or
// shrink, the number of repetitions is rounded to nearest and at least 1; otherwise it is rounded down. The rigid parts
// of all repetitions must fit in any case. The flexible parts divide the remaining length in proportion to their
// preferred lengths; without flexible parts, the remaining length stays empty at the high end. If the rigid parts are
// too long together, they are cut off at the end of the length.

#include <cstdint>
#include <span>
#include <vector>

namespace sgm {

/// The size of a part in metres, at least 0.
struct SplitSize {
  double size = 0;
  bool flexible = false;  ///< true: `size` is a preferred size; the part may stretch or shrink
  bool repeated = false;  ///< true: the part belongs to the repeated group, a run of consecutive parts
};

/// The position of a part, in metres from the low end. It is stored as length and middle instead of two ends, so that
/// equal parts in a run have bitwise equal lengths.
struct SplitPlace {
  uint32_t part = 0;        ///< index of the part in the input of layOut()
  uint32_t repetition = 0;  ///< index of the repetition of the group, from 0; 0 outside of the group
  double middle = 0, size = 0;
};

struct SplitLayout {
  std::vector<SplitPlace> places;  ///< places of the parts with a non-zero size, in order
  double repetitions = 0;          ///< number of repetitions of the split's repeated group of parts
  bool cut_off = false;            ///< true: the rigid parts together exceed the length
  bool too_many = false;           ///< true: there would be more than `most` parts; `places` is empty
};

/// Lays out the parts along a length in metres, above 0. most: maximum number of places.
SplitLayout layOut(double length, std::span<const SplitSize> parts, size_t most);

}  // namespace sgm
