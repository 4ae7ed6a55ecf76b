#include "tools/survey/columns.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "backend/cpu/instruction_sets.h"
#include "field/prune.h"

namespace sgm::survey {
namespace {

constexpr int kTile = 32;          // columns along an edge of a tile; one field program is compiled for each tile
constexpr int kBrick = 8;          // samples along an edge of a brick, the unit of one evaluation call
constexpr float kDeep = 2;         // in sample spacings; field values are clamped to -kDeep..kDeep
constexpr float kPassable = 1;     // metres, minimum height of an interval through which a person can pass
constexpr float kRockBetween = 1;  // metres, minimum thickness of the rock between two passages that are both drawn

/// Samples the field in a box; x varies fastest, then z, then y. Not thread-safe.
class TileFill {
 public:
  TileFill(Int3 origin, int32_t step, std::array<int, 3> size)
      : origin_(origin), step_(step), size_(size), values_(static_cast<size_t>(size[0] * size[1] * size[2])) {}

  void fill(const ProgramView& view) { fillPart(view, {}, size_, 0); }

  /// The field's value at a sample, in multiples of the sample spacing, clamped to -kDeep..kDeep; negative in the
  /// solid.
  float at(int x, int y, int z) const { return values_[index(x, y, z)]; }

 private:
  size_t index(int x, int y, int z) const { return static_cast<size_t>((y * size_[2] + z) * size_[0] + x); }

  void fillPart(const ProgramView& view, std::array<int, 3> from, std::array<int, 3> count, size_t depth) {
    IntBox box;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<size_t>(axis);
      box.lo[axis] = origin_[axis] + from[a] * step_;
      box.hi[axis] = box.lo[axis] + (count[a] - 1) * step_;
    }
    PrunedProgram& pruned = pruned_[depth];
    prune(view, box, pruning_, pruned, Uniform::keep);
    const double deep = static_cast<double>(kDeep) * step_;
    if (pruned.field.lo > deep || pruned.field.hi < -deep) return fillUniform(from, count, pruned.field.lo > 0);
    if (count[0] <= kBrick && count[1] <= kBrick && count[2] <= kBrick) return evaluate(pruned.view(), from, count);
    const int edge = depth == 0 ? kTile : kBrick;
    for (int y = 0; y < count[1]; y += edge) {
      for (int z = 0; z < count[2]; z += edge) {
        for (int x = 0; x < count[0]; x += edge) {
          fillPart(pruned.view(), {from[0] + x, from[1] + y, from[2] + z},
                   {std::min(edge, count[0] - x), std::min(edge, count[1] - y), std::min(edge, count[2] - z)},
                   depth + 1);
        }
      }
    }
  }

  void fillUniform(std::array<int, 3> from, std::array<int, 3> count, bool open) {
    for (int y = 0; y < count[1]; ++y)
      for (int z = 0; z < count[2]; ++z)
        std::fill_n(values_.begin() + static_cast<std::ptrdiff_t>(index(from[0], from[1] + y, from[2] + z)), count[0],
                    open ? kDeep : -kDeep);
  }

  void evaluate(const ProgramView& view, std::array<int, 3> from, std::array<int, 3> count) {
    size_t points = 0;
    for (int y = 0; y < count[1]; ++y) {
      for (int z = 0; z < count[2]; ++z) {
        for (int x = 0; x < count[0]; ++x, ++points) {
          x_[points] = origin_.x + (from[0] + x) * step_;
          y_[points] = origin_.y + (from[1] + y) * step_;
          z_[points] = origin_.z + (from[2] + z) * step_;
        }
      }
    }
    bestKernels().samples(view, {x_.data(), y_.data(), z_.data(), points}, evaluation_, q_.data());
    // Field values are integers. A sample exactly on the surface (value 0) must count as void, as in meshes, so an
    // offset makes its value positive.
    const float steps = 1 / (view.q_scale * static_cast<float>(step_));
    points = 0;
    for (int y = 0; y < count[1]; ++y)
      for (int z = 0; z < count[2]; ++z)
        for (int x = 0; x < count[0]; ++x, ++points)
          values_[index(from[0] + x, from[1] + y, from[2] + z)] =
              std::clamp((static_cast<float>(q_[points]) + 0.25f) * steps, -kDeep, kDeep);
  }

  Int3 origin_;
  int32_t step_;
  std::array<int, 3> size_;
  std::vector<float> values_;
  PruneScratch pruning_;
  std::array<PrunedProgram, 3> pruned_;
  EvalScratch evaluation_;
  std::array<int32_t, size_t{kBrick} * kBrick * kBrick> x_{}, y_{}, z_{}, q_{};
};

/// The intervals of one column in the subject (the void or the solid that is drawn), and the column's values for a plan
/// (a view from above).
struct Column {
  std::vector<Stretch> stretches;
  uint32_t shown = kNone;
  float widest = -kDeep, under = -kDeep;
  uint32_t floor_label = 0, ceiling_label = 0;
};

/// Finds the intervals of the subject in one column. value(i): the field at sample i, counted from the bottom, in
/// multiples of the sample spacing; positive inside the subject.
template <class Value>
Column readColumn(int samples, float bottom, float step, const Value& value) {
  Column column;
  for (int i = 0; i < samples; ++i) {
    const float here = value(i);
    column.widest = std::max(column.widest, here);
    const float before = i > 0 ? value(i - 1) : -1;
    if (here > 0 && before <= 0) {
      Stretch stretch;
      stretch.cut_below = i == 0;
      stretch.bottom = bottom + step * (i == 0 ? 0 : static_cast<float>(i) - here / (here - before));
      column.stretches.push_back(stretch);
    }
    if (here <= 0 && before > 0)
      column.stretches.back().top = bottom + step * (static_cast<float>(i) - here / (here - before));
    if (here > 0 && i + 1 == samples) {
      column.stretches.back().top = bottom + step * static_cast<float>(i);
      column.stretches.back().cut_above = true;
    }
  }
  if (column.stretches.empty()) return column;
  size_t shown = 0;
  for (size_t i = 0; i < column.stretches.size(); ++i) {
    const float height = column.stretches[i].height(), best = column.stretches[shown].height();
    if (height >= kPassable || height > best) shown = i;
  }
  column.shown = static_cast<uint32_t>(shown);
  const float roof = column.stretches[shown].bottom - kRockBetween;
  for (size_t i = 0; i < shown; ++i) {
    const Stretch& below = column.stretches[i];
    if (below.top > roof || below.height() < kPassable) continue;
    for (int s = 0; s < samples; ++s) {
      const float height = bottom + step * static_cast<float>(s);
      if (height >= below.bottom - step && height <= below.top + step) column.under = std::max(column.under, value(s));
    }
  }
  return column;
}

/// The regular lattice of samples over the whole region.
struct Lattice {
  Int3 origin;
  int32_t step = 0;
  std::array<int, 3> size{};
};

Result<void> readTile(const WorldField& world, int level, const Lattice& lattice, int left, int front, Subject subject,
                      std::vector<Column>& columns) {
  const std::array<int, 3> count{std::min(kTile, lattice.size[0] - left), lattice.size[1],
                                 std::min(kTile, lattice.size[2] - front)};
  const Int3 origin{lattice.origin.x + left * lattice.step, lattice.origin.y, lattice.origin.z + front * lattice.step};
  const IntBox box{origin,
                   {origin.x + (count[0] - 1) * lattice.step, origin.y + (count[1] - 1) * lattice.step,
                    origin.z + (count[2] - 1) * lattice.step}};
  const Result<std::shared_ptr<const FieldProgram>> program = world.compile(box, level);
  if (!program) return program.error();
  TileFill tile(origin, lattice.step, count);
  tile.fill((*program)->view());
  std::vector<Int3> ends;
  std::vector<Column*> owners;
  for (int z = 0; z < count[2]; ++z) {
    for (int x = 0; x < count[0]; ++x) {
      Column& column = columns[static_cast<size_t>(front + z) * static_cast<size_t>(lattice.size[0]) +
                               static_cast<size_t>(left + x)];
      column = readColumn(count[1], static_cast<float>(metres(origin.y)), static_cast<float>(metres(lattice.step)),
                          [&](int y) { return subject == Subject::hollow ? tile.at(x, y, z) : -tile.at(x, y, z); });
      if (column.shown == kNone) continue;
      owners.push_back(&column);
      const Stretch& stretch = column.stretches[column.shown];
      for (const float height : {stretch.bottom, stretch.top}) {
        const Int3 end{origin.x + x * lattice.step, static_cast<int32_t>(std::lround(height * kUnitsPerMetre)),
                       origin.z + z * lattice.step};
        ends.push_back({end.x, std::clamp(end.y, box.lo.y, box.hi.y), end.z});
      }
    }
  }
  std::vector<uint32_t> labels;
  const Result<std::vector<float>> values = valuesAt(world, level, box, ends, &labels);
  if (!values) return values.error();
  for (size_t i = 0; i < owners.size(); ++i) {
    owners[i]->floor_label = labels[2 * i];
    owners[i]->ceiling_label = labels[2 * i + 1];
  }
  return {};
}

Columns gathered(Subject subject, const Lattice& lattice, std::vector<Column> read) {
  Columns columns;
  columns.subject = subject;
  columns.step = lattice.step;
  columns.extent.lo = lattice.origin;
  for (int axis = 0; axis < 3; ++axis)
    columns.extent.hi[axis] = lattice.origin[axis] + (lattice.size[static_cast<size_t>(axis)] - 1) * lattice.step;
  columns.widest = columns.under = Grid(lattice.size[0], lattice.size[2], 0);
  for (size_t i = 0; i < read.size(); ++i) {
    const Column& column = read[i];
    columns.widest.values[i] = column.widest;
    columns.under.values[i] = column.under;
    const auto first = static_cast<uint32_t>(columns.stretches.size());
    columns.first.push_back(first);
    columns.shown.push_back(column.shown == kNone ? kNone : first + column.shown);
    columns.stretches.insert(columns.stretches.end(), column.stretches.begin(), column.stretches.end());
    columns.floor_label.push_back(column.floor_label);
    columns.ceiling_label.push_back(column.ceiling_label);
  }
  columns.first.push_back(static_cast<uint32_t>(columns.stretches.size()));
  return columns;
}

}  // namespace

Result<std::vector<float>> valuesAt(const WorldField& world, int level, const IntBox& box, std::span<const Int3> points,
                                    std::vector<uint32_t>* labels) {
  std::vector<float> values(points.size());
  if (labels != nullptr) labels->resize(points.size());
  if (points.empty()) return values;
  const Result<std::shared_ptr<const FieldProgram>> program = world.compile(box, level);
  if (!program) return program.error();
  std::array<std::vector<int32_t>, 3> axes;
  for (int axis = 0; axis < 3; ++axis)
    for (const Int3& p : points) axes[static_cast<size_t>(axis)].push_back(p[axis]);
  Attributes wanted;
  wanted.value = values.data();
  wanted.label = labels != nullptr ? labels->data() : nullptr;
  EvalScratch scratch;
  bestKernels().attributes((*program)->view(), {axes[0].data(), axes[1].data(), axes[2].data(), points.size()}, scratch,
                           wanted);
  return values;
}

Result<Columns> sampleColumns(const WorldField& world, const IntBox& region, int level, JobSystem& jobs,
                              const Progress& progress) {
  Lattice lattice;
  lattice.step = world.cellAt(level);
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t from = floorDiv(region.lo[axis], lattice.step),
                  to = -floorDiv(-int64_t{region.hi[axis]}, lattice.step);
    if (to * lattice.step > INT32_MAX || from * lattice.step < INT32_MIN)
      return Error{Code::range, "the region extends beyond the world, which ends about 2,097 km from the origin"};
    lattice.origin[axis] = static_cast<int32_t>(from * lattice.step);
    lattice.size[static_cast<size_t>(axis)] = static_cast<int>(to - from + 1);
  }
  const int64_t columns_seen = int64_t{lattice.size[0]} * lattice.size[2];
  if (columns_seen > kMaxColumns || lattice.size[1] > kTallest)
    return Error{Code::limit, fmt::format("a survey may have at most {} columns of {} samples, but this region has {} "
                                          "of {}: choose larger cells or a smaller --region",
                                          kMaxColumns, kTallest, columns_seen, lattice.size[1])};
  const Subject subject = world.isSolidDomain() ? Subject::hollow : Subject::solid;
  const int across = (lattice.size[0] + kTile - 1) / kTile, along = (lattice.size[2] + kTile - 1) / kTile;
  std::vector<Column> columns(static_cast<size_t>(lattice.size[0]) * static_cast<size_t>(lattice.size[2]));
  std::mutex mutex;
  std::optional<Error> error;
  uint64_t done = 0;
  parallelFor(jobs, static_cast<size_t>(across) * static_cast<size_t>(along), [&](size_t tile) {
    {
      const std::lock_guard lock(mutex);
      if (error) return;
    }
    const int left = static_cast<int>(tile) % across * kTile, front = static_cast<int>(tile) / across * kTile;
    const Result<void> read = readTile(world, level, lattice, left, front, subject, columns);
    const std::lock_guard lock(mutex);
    if (error) return;
    if (!read)
      error = read.error();
    else if (progress && !progress(++done, static_cast<uint64_t>(across) * static_cast<uint64_t>(along)))
      error = Error{Code::cancelled, "sampling the region was cancelled"};
  });
  if (error) return *error;
  return gathered(subject, lattice, std::move(columns));
}

}  // namespace sgm::survey
