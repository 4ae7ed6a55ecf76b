#pragma once
// Samples a region's field on a vertical plane, the cut of a section.

#include <optional>
#include <string_view>

#include "tools/survey/columns.h"

namespace sgm::survey {

/// The line of a section, seen from above: coordinates of both ends, in metres of the world.
struct CutLine {
  double x0 = 0, z0 = 0, x1 = 0, z1 = 0;
  double length() const;
};

/// Parses "X,Z:X,Z" in metres; nullopt if the text is not a pair of different points within the world.
std::optional<CutLine> readCutLine(std::string_view text);

/// Returns a line for the cut: it crosses the whole region, parallel to the region's longer horizontal axis, where the
/// area of the subject in the cut (the void or the solid that is drawn) is nearly the largest.
CutLine longestCut(const Columns& columns);

/// The samples on the vertical plane of a cut. Columns follow the line from its start; rows go down from the top.
struct Slice {
  CutLine line;
  Subject subject = Subject::hollow;
  double step = 0;  ///< metres between neighbouring samples
  double top = 0;   ///< metres, height of row 0
  /// For each sample, its depth inside the subject (the void or the solid that is drawn), as a multiple of `step`, at
  /// most 2; negative outside the subject.
  Grid depth;
  std::vector<uint32_t> label;  ///< for each sample: tag << 16 | material in the solid, 0 in the void
  /// Projection of the subject onto the plane of the cut: 1 if the subject lies anywhere in front of, on or behind the
  /// sample, otherwise -1.
  Grid beyond;

  double heightAt(double row) const { return top - row * step; }
};

/// Samples the cut along `line` within the region of the columns. Errors: invalid_argument if the line misses the
/// region; those of compiling the field.
Result<Slice> sampleSlice(const WorldField& world, const Columns& columns, int level, const CutLine& line,
                          JobSystem& jobs);

}  // namespace sgm::survey
