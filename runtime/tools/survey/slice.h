#pragma once
// Samples a region's field on a vertical cut along a line seen from above.

#include <optional>
#include <string_view>

#include "tools/survey/columns.h"

namespace sgm::survey {

/// Ends of the line along which a section cuts, as seen from above; metres of the world.
struct CutLine {
  double x0 = 0, z0 = 0, x1 = 0, z1 = 0;
  double length() const;
};

/// Parses "X,Z:X,Z" in metres; nullopt if the text is not a pair of different places of the world.
std::optional<CutLine> readCutLine(std::string_view text);

/// A cut parallel to the region's longer horizontal axis, at the place where it meets the largest area of the subject.
CutLine longestCut(const Columns& columns);

/// Samples on the cut: column x counts steps along the line, row y counts steps down from the top.
struct Slice {
  CutLine line;
  Subject subject = Subject::hollow;
  double step = 0;              ///< distance between samples, metres
  double top = 0;               ///< height of row 0, metres
  Grid depth;                   ///< depth of each sample inside the subject, in steps, at most 2; negative outside
  std::vector<uint32_t> label;  ///< for each sample in the solid: tag << 16 | material; otherwise 0
  Grid beyond;  ///< the subject of all columns projected onto the cut: 1 inside the projection, -1 outside

  double heightAt(double row) const { return top - row * step; }
};

/// Samples the cut within the columns' region. Errors: invalid_argument if the line does not meet the region; those of
/// compiling the field.
Result<Slice> sampleSlice(const WorldField& world, const Columns& columns, int level, const CutLine& line,
                          JobSystem& jobs);

}  // namespace sgm::survey
