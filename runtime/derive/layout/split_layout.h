#pragma once
// Divides a length among the parts of a split. After CGA (Mueller, Wonka, Haegler, Ulmer, Van Gool, Procedural Modeling
// of Buildings, SIGGRAPH 2006, section 3).
//
// Rigid parts have exactly their length. The group is repeated as often as fits beside the other parts, with flexible
// parts at their preferred lengths. If the group has flexible parts, which stretch or shrink to fit, the number is
// rounded to nearest and at least 1; otherwise it is rounded down. The group is never repeated more often than its
// rigid parts fit. The flexible parts share the remaining length in proportion to their preferred lengths; without
// flexible parts it stays empty at the high end. Parts that are too long together are cut off at the end of the length.

#include <cstdint>
#include <span>
#include <vector>

namespace sgm {

/// Metres, at least 0.
struct SplitSize {
  double size = 0;
  bool flexible = false;  ///< size is the preferred size
  bool repeated = false;  ///< in the group, one run of parts
};

/// The position of a part, metres from the low end. It is given by length and middle: in a run of equal parts the
/// lengths are equal to the bit.
struct SplitPlace {
  uint32_t part = 0;
  uint32_t repetition = 0;  ///< of the group, from 0
  double middle = 0, size = 0;
};

struct SplitLayout {
  std::vector<SplitPlace> places;  ///< the parts with a size, in order
  double repetitions = 0;          ///< of the group
  bool cut_off = false;            ///< rigid parts are too long together
  bool too_many = false;           ///< more parts than `most`: no places
};

/// length: metres, above 0.
SplitLayout layOut(double length, std::span<const SplitSize> parts, size_t most);

}  // namespace sgm
