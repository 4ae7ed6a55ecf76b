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

/// A line across the whole region, parallel to its longer horizontal axis. It is placed where the cut has nearly the
/// largest area of the subject (the void or the solid that is drawn).
CutLine longestCut(const Columns& columns);

/// The samples on the vertical plane of a cut. Columns follow the line from its start; rows go down from the top.
struct Slice {
  CutLine line;
  Subject subject = Subject::hollow;
  double step = 0;  ///< metres between neighbouring samples
  double top = 0;   ///< metres, height of row 0
  /// For each sample, depth in steps, at most 2, inside the void or solid that is drawn; negative outside it.
  Grid depth;
  std::vector<uint32_t> label;  ///< for each sample: tag << 16 | material in the solid, 0 in the void
  /// Projection of all void or solid that is drawn, from the whole region, onto the cut: 1 inside, -1 outside.
  Grid beyond;

  double heightAt(double row) const { return top - row * step; }
};

/// Samples the cut along `line` within the region of the columns. Errors: invalid_argument if the line misses the
/// region; those of compiling the field.
Result<Slice> sampleSlice(const WorldField& world, const Columns& columns, int level, const CutLine& line,
                          JobSystem& jobs);

}  // namespace sgm::survey
