#pragma once
// Samples a region's field on vertical columns: finds the intervals of void and solid in each column.

#include <vector>

#include "base/jobs.h"
#include "chunk/mesh_chunks.h"
#include "tools/survey/contour.h"
#include "world/world_field.h"

namespace sgm::survey {

/// The part of the world that a survey draws: the void of a cave, or the solid of an open world.
enum class Subject { hollow, solid };

/// A vertical interval of a column that belongs to the subject; heights in metres of the world.
struct Stretch {
  float bottom = 0, top = 0;
  bool cut_below = false, cut_above = false;  ///< the interval continues below the region's floor, or above its ceiling
  float height() const { return top - bottom; }
};

/// The columns at the points (x, z) of a square grid, with the samples of one level of detail.
struct Columns {
  Subject subject = Subject::hollow;
  IntBox extent;     ///< box of the samples, units; there are samples at lo and at hi
  int32_t step = 0;  ///< distance between neighbouring samples on every axis, units
  /// For each column, the largest depth inside the subject, in steps, at most 2; negative if the column is outside it.
  Grid widest;
  Grid under;  ///< the same for the part of the subject below the shown stretch, if rock separates the two
  /// Index in `stretches` of each column's first stretch; the last element is the number of stretches.
  std::vector<uint32_t> first;
  std::vector<Stretch> stretches;  ///< the stretches of all columns, in each column from below
  std::vector<uint32_t> shown;     ///< for each column, the index of the stretch that a plan shows; kNone: none
  /// For each column, the labels at both ends of its shown stretch: tag << 16 | material.
  std::vector<uint32_t> floor_label, ceiling_label;

  const Stretch* shownAt(size_t column) const { return shown[column] == kNone ? nullptr : &stretches[shown[column]]; }
  double xAt(double column) const { return metres(extent.lo.x) + column * metres(step); }
  double zAt(double row) const { return metres(extent.lo.z) + row * metres(step); }
};

/// The maximum number of columns of a region, and the maximum number of samples in a column.
inline constexpr int64_t kMaxColumns = int64_t{1} << 24;
inline constexpr int kTallest = 1 << 16;

/// Samples `region`, enlarged to whole steps, at a level of detail. A column shows the uppermost stretch that is high
/// enough for a person (one metre), otherwise its tallest stretch. Errors: limit and range if the region is too large;
/// those of compiling the field; cancelled if progress returns false.
Result<Columns> sampleColumns(const WorldField& world, const IntBox& region, int level, JobSystem& jobs,
                              const Progress& progress = {});

/// Values of the field at points, in units, negative in the solid. Also sets the labels of the points unless `labels`
/// is null. box: must contain all points. Errors: those of compiling the field.
Result<std::vector<float>> valuesAt(const WorldField& world, int level, const IntBox& box, std::span<const Int3> points,
                                    std::vector<uint32_t>* labels = nullptr);

}  // namespace sgm::survey
