#pragma once
// Samples a region's field along vertical columns, and finds the intervals of void or solid in each column.

#include <vector>

#include "base/jobs.h"
#include "chunk/mesh_chunks.h"
#include "tools/survey/contour.h"
#include "world/world_field.h"

namespace sgm::survey {

/// The part of the world that a survey draws: the void (of a cave), or the solid (of an open world).
enum class Subject { hollow, solid };

/// A vertical interval of a column within the subject (the void or the solid that is drawn). Heights are in metres of
/// the world.
struct Stretch {
  float bottom = 0, top = 0;
  bool cut_below = false, cut_above = false;  ///< whether the region's floor (below) or ceiling (above) cuts off the
                                              ///< interval
  float height() const { return top - bottom; }
};

/// A region's columns, one at each point (x, z) of a square grid, sampled at one level of detail.
struct Columns {
  Subject subject = Subject::hollow;
  IntBox extent;     ///< box of the samples, units; the first samples are at lo, the last ones at hi
  int32_t step = 0;  ///< distance between neighbouring samples along each axis, units
  /// For each column, the depth of the sample that lies deepest inside the subject (the void or the solid that is
  /// drawn): about the sample's distance from the surface, in steps; at most 2. Negative if no sample of the column is
  /// inside the subject.
  Grid widest;
  /// Like `widest`, but only for passages below the shown interval that are at least one metre high, with at least one
  /// metre of rock between them and the shown interval. Negative if the column has no such passage.
  Grid under;
  /// For each column, the index of its first interval in `stretches`. One more element at the end: the number of
  /// intervals.
  std::vector<uint32_t> first;
  std::vector<Stretch> stretches;  ///< intervals of all columns, one column after another, each from bottom to top
  std::vector<uint32_t> shown;     ///< for each column, index of the interval that a plan shows; kNone if there is none
  /// For each column, the labels (tag << 16 | material) at the lower and the upper end of its shown interval.
  std::vector<uint32_t> floor_label, ceiling_label;

  const Stretch* shownAt(size_t column) const { return shown[column] == kNone ? nullptr : &stretches[shown[column]]; }
  double xAt(double column) const { return metres(extent.lo.x) + column * metres(step); }
  double zAt(double row) const { return metres(extent.lo.z) + row * metres(step); }
};

/// Maximum number of columns in a region, and maximum number of samples in a column.
inline constexpr int64_t kMaxColumns = int64_t{1} << 24;
inline constexpr int kTallest = 1 << 16;

/// Samples `region`, rounded outwards to whole steps, at a level of detail. The shown interval of a column is the
/// uppermost one that is at least one metre high, so that a person can pass; if there is none, the highest one. Errors:
/// limit or range if the region is too large; those of compiling the field; cancelled if progress returns false.
Result<Columns> sampleColumns(const WorldField& world, const IntBox& region, int level, JobSystem& jobs,
                              const Progress& progress = {});

/// Values of the field at points, in units, negative in the solid. If `labels` is not null, it receives the points'
/// labels. box: a box that contains all points. Errors: those of compiling the field.
Result<std::vector<float>> valuesAt(const WorldField& world, int level, const IntBox& box, std::span<const Int3> points,
                                    std::vector<uint32_t>* labels = nullptr);

}  // namespace sgm::survey
