#pragma once
// How the parts of a split share a length. After CGA (Mueller, Wonka, Haegler, Ulmer, Van Gool, Procedural Modeling of
// Buildings, SIGGRAPH 2006, section 3).
//
// Rigid parts are as long as they say. The group is repeated as often as fits beside the other parts, flexible ones at
// the lengths they would like: to the nearest whole number, at least once, where it has flexible parts, which stretch
// or shrink to fit, and rounded down where it has none; never more often than its rigid parts fit. What is left then is
// shared by the flexible parts in proportion to the lengths that they would like, and stays empty at the high end where
// there are none. Parts that are too long together are cut off at the end of the length.

#include <cstdint>
#include <span>
#include <vector>

namespace sgm {

/// Metres, at least 0.
struct SplitSize {
  double size = 0;
  bool flexible = false;  ///< size is what it would like
  bool repeated = false;  ///< in the group, one run of parts
};

/// Where a part lies, metres from the low end. Length and middle: a run of equal parts is equal to the bit.
struct SplitPlace {
  uint32_t part = 0;
  uint32_t repetition = 0;  ///< of the group, from 0
  double middle = 0, size = 0;
};

struct SplitLayout {
  std::vector<SplitPlace> places;  ///< those with a size, in order
  double repetitions = 0;          ///< of the group
  bool cut_off = false;            ///< rigid parts are too long together
  bool too_many = false;           ///< more parts than `most`: no places
};

/// length: metres, above 0.
SplitLayout layOut(double length, std::span<const SplitSize> parts, size_t most);

}  // namespace sgm
