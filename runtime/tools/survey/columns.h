#pragma once
// A region's field on vertical columns: the intervals of void and solid in each.

#include <vector>

#include "base/jobs.h"
#include "chunk/mesh_chunks.h"
#include "tools/survey/contour.h"
#include "world/world_field.h"

namespace sgm::survey {

/// The subject of a survey: a cave's void, or the solid of an open world.
enum class Subject { hollow, solid };

/// An interval of a column in the subject, metres of the world.
struct Stretch {
  float bottom = 0, top = 0;
  bool cut_below = false, cut_above = false;  ///< continues below the region's floor, above its ceiling
  float height() const { return top - bottom; }
};

/// Columns at points (x, z) of a square grid, with the samples of a level.
struct Columns {
  Subject subject = Subject::hollow;
  IntBox extent;     ///< of the samples, units; includes samples at lo and hi
  int32_t step = 0;  ///< units from one sample to the next, on every axis
  Grid widest;       ///< the largest depth in the subject on the column, in steps, at most 2; negative outside
  Grid under;        ///< the same for passages below the shown stretch, with rock between the two
  std::vector<uint32_t> first;     ///< index of each column's first stretch; one more at the end
  std::vector<Stretch> stretches;  ///< of each column from below
  std::vector<uint32_t> shown;     ///< for each column, the stretch shown in a plan; kNone: none
  /// For each column, the labels at the ends of its shown stretch: tag << 16 | material.
  std::vector<uint32_t> floor_label, ceiling_label;

  const Stretch* shownAt(size_t column) const { return shown[column] == kNone ? nullptr : &stretches[shown[column]]; }
  double xAt(double column) const { return metres(extent.lo.x) + column * metres(step); }
  double zAt(double row) const { return metres(extent.lo.z) + row * metres(step); }
};

/// The maximal number of columns of a region, and of samples of a column.
inline constexpr int64_t kMostColumns = int64_t{1} << 24;
inline constexpr int kTallest = 1 << 16;

/// Samples `region`, grown to whole steps, at a level. A column shows its uppermost stretch that a person fits into (a
/// metre high), otherwise its tallest one. Errors: limit and range if it is too large; those of compiling the field;
/// cancelled if progress returns false.
Result<Columns> sampleColumns(const WorldField& world, const IntBox& region, int level, JobSystem& jobs,
                              const Progress& progress = {});

/// Values of the field at points, in units, negative in the solid; also their labels unless `labels` is null. box:
/// contains all points. Errors: those of compiling the field.
Result<std::vector<float>> valuesAt(const WorldField& world, int level, const IntBox& box, std::span<const Int3> points,
                                    std::vector<uint32_t>* labels = nullptr);

}  // namespace sgm::survey
