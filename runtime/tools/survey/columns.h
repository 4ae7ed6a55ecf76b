#pragma once
// A region's field on upright columns: where each passes through void and through solid.

#include <vector>

#include "base/jobs.h"
#include "chunk/mesh_chunks.h"
#include "tools/survey/contour.h"
#include "world/world_field.h"

namespace sgm::survey {

/// What a survey draws: a cave's void, or the solid of a world that is open.
enum class Subject { hollow, solid };

/// A stretch of a column in the subject, metres of the world.
struct Stretch {
  float bottom = 0, top = 0;
  bool cut_below = false, cut_above = false;  ///< it goes on below the region's floor, above its ceiling
  float height() const { return top - bottom; }
};

/// Columns at points (x, z) of a square grid, with the samples of a level.
struct Columns {
  Subject subject = Subject::hollow;
  IntBox extent;     ///< of the samples, units: lo and hi hold some
  int32_t step = 0;  ///< units from one sample to the next, on every axis
  Grid widest;       ///< the largest depth in the subject on the column, in steps, at most 2; outside of it below 0
  Grid under;        ///< the same of what lies below the stretch that is shown, with rock between the two
  std::vector<uint32_t> first;     ///< of each column among the stretches; one more at the end
  std::vector<Stretch> stretches;  ///< of a column from below
  std::vector<uint32_t> shown;     ///< of each column, the stretch that a plan shows; kNone: none
  /// Of each column, what its shown stretch ends at: tag << 16 | material.
  std::vector<uint32_t> floor_label, ceiling_label;

  const Stretch* shownAt(size_t column) const { return shown[column] == kNone ? nullptr : &stretches[shown[column]]; }
  double xAt(double column) const { return metres(extent.lo.x) + column * metres(step); }
  double zAt(double row) const { return metres(extent.lo.z) + row * metres(step); }
};

/// The most columns of one region, and the most samples of a column.
inline constexpr int64_t kMostColumns = int64_t{1} << 24;
inline constexpr int kTallest = 1 << 16;

/// Samples of `region`, grown to whole steps, at a level. A column shows its uppermost stretch that a person could be
/// in (a metre high), else its highest one. Errors: limit and range for what is too large; those of compiling the
/// field; cancelled where progress returns false.
Result<Columns> sampleColumns(const WorldField& world, const IntBox& region, int level, JobSystem& jobs,
                              const Progress& progress = {});

/// Values of the field at points, in units, negative in the solid; and their labels where `labels` is not null.
/// Errors: those of compiling the field. box: holds all points.
Result<std::vector<float>> valuesAt(const WorldField& world, int level, const IntBox& box, std::span<const Int3> points,
                                    std::vector<uint32_t>* labels = nullptr);

}  // namespace sgm::survey
