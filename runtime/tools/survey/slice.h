#pragma once
// A vertical cut through a region's field, along a line seen from above.

#include <optional>
#include <string_view>

#include "tools/survey/columns.h"

namespace sgm::survey {

/// The line of a section, metres of the world.
struct CutLine {
  double x0 = 0, z0 = 0, x1 = 0, z1 = 0;
  double length() const;
};

/// "X,Z:X,Z" in metres; nullopt if the text is not two different places of the world.
std::optional<CutLine> readCutLine(std::string_view text);

/// Along the region's longer horizontal axis, where the cut area of the subject is largest.
CutLine longestCut(const Columns& columns);

/// Samples on the cut: x counts steps along the line, y counts steps down from the top.
struct Slice {
  CutLine line;
  Subject subject = Subject::hollow;
  double step = 0;              ///< metres
  double top = 0;               ///< metres: height of row 0
  Grid depth;                   ///< in the subject, steps, at most 2; negative outside
  std::vector<uint32_t> label;  ///< tag << 16 | material of samples in the solid; otherwise 0
  Grid beyond;                  ///< the projection of the subject of all columns: 1 or -1

  double heightAt(double row) const { return top - row * step; }
};

/// The cut through the columns' region. Errors: invalid_argument if the line does not meet the region; those of
/// compiling the field.
Result<Slice> sampleSlice(const WorldField& world, const Columns& columns, int level, const CutLine& line,
                          JobSystem& jobs);

}  // namespace sgm::survey
