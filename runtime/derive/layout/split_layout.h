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
  bool flexible = false;  ///< size is a preferred size, which may change
  bool repeated = false;  ///< belongs to the repeated group, a run of consecutive parts
};

/// The position of a part in metres from the low end, as length and middle, so that equal parts in a run have bitwise
/// equal lengths.
struct SplitPlace {
  uint32_t part = 0;        ///< index of the part in the input
  uint32_t repetition = 0;  ///< which repetition of the group, from 0
  double middle = 0, size = 0;
};

struct SplitLayout {
  std::vector<SplitPlace> places;  ///< the parts with a non-zero size, in order
  double repetitions = 0;          ///< number of repetitions of the group
  bool cut_off = false;            ///< the rigid parts together exceed the length
  bool too_many = false;           ///< there would be more than `most` parts; places is empty
};

/// Lays out the parts in `length` metres, above 0.
SplitLayout layOut(double length, std::span<const SplitSize> parts, size_t most);

}  // namespace sgm
