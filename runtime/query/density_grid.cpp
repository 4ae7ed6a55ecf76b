#include "query/density_grid.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "backend/cpu/instruction_sets.h"
#include "field/density.h"
#include "field/prune.h"
#include "grammar/text/sink.h"

namespace sgm {

namespace {

constexpr uint32_t kBrick = 8;  // edge of a brick in points; the points of a brick are evaluated together
constexpr uint32_t kBlock = 4 * kBrick;
// number of sizes of parts: a block has 32 points per edge; it is halved to 16, and then to bricks of 8
constexpr size_t kDepths = 3;

/// A box of the grid's points.
struct Part {
  std::array<uint32_t, 3> first{}, count{};
};

uint64_t bricksOf(const Part& part) {
  uint64_t bricks = 1;
  for (const uint32_t n : part.count) bricks *= (n + kBrick - 1) / kBrick;
  return bricks;
}

int32_t coordinate(const DensityGrid& grid, int axis, uint32_t i) {
  return static_cast<int32_t>(grid.origin[axis] + int64_t{grid.spacing} * i);
}

IntBox boxOf(const DensityGrid& grid, const Part& part) {
  IntBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    box.lo[axis] = coordinate(grid, axis, part.first[a]);
    box.hi[axis] = coordinate(grid, axis, part.first[a] + part.count[a] - 1);
  }
  return box;
}

/// Divides a part into smaller parts of this edge length (in points), and calls visit for each, in order.
template <class Visit>
void cut(const Part& whole, uint32_t edge, const Visit& visit) {
  std::array<uint32_t, 3> at{};
  for (at[2] = 0; at[2] < whole.count[2]; at[2] += edge) {
    for (at[1] = 0; at[1] < whole.count[1]; at[1] += edge) {
      for (at[0] = 0; at[0] < whole.count[0]; at[0] += edge) {
        Part part;
        for (size_t a = 0; a < 3; ++a) {
          part.first[a] = whole.first[a] + at[a];
          part.count[a] = std::min(edge, whole.count[a] - at[a]);
        }
        visit(part);
      }
    }
  }
}

/// Writes the densities of one block. Not thread-safe.
class BlockFill {
 public:
  BlockFill(const DensityGrid& grid, const DensityEdge& edge, const DensityRows& rows,
            std::pmr::memory_resource* memory)
      : grid_(grid),
        edge_(edge),
        rows_(rows),
        pruning_(memory),
        pruned_{PrunedProgram(memory), PrunedProgram(memory), PrunedProgram(memory)},
        evaluation_(memory) {}

  DensityFigures figures;

  /// Writes the densities of a part, which has at most `edge` points along each axis. A part larger than a brick is
  /// halved along each axis, unless its density is proven to be uniform.
  void fill(const ProgramView& view, const Part& part, uint32_t edge, size_t depth = 0) {
    PrunedProgram& pruned = pruned_[depth];
    prune(view, boxOf(grid_, part), pruning_, pruned, Uniform::keep);
    // The part is proven full if all of it lies deeper in the solid than the soft edge of the density reaches
    // (edge_.steps). The margin of two steps covers the rounding errors of the samples, and of the product on the left
    // side.
    const bool full = pruned.field.hi * static_cast<double>(pruned.q_scale) < -(edge_.steps + 2);
    if (pruned.empty() || full) {
      figures.bricks += bricksOf(part);
      figures.uniform += bricksOf(part);
      fillUniform(part, full);
    } else if (edge <= kBrick) {
      ++figures.bricks;
      evaluate(pruned.view(), part);
    } else {
      cut(part, edge / 2, [&](const Part& half) { fill(pruned.view(), half, edge / 2, depth + 1); });
    }
  }

 private:
  template <class Row>
  void eachRow(const Part& part, const Row& row) const {
    for (uint32_t z = 0; z < part.count[2]; ++z) {
      for (uint32_t y = 0; y < part.count[1]; ++y) {
        row((part.first[2] + z) * rows_.slice_pitch + (part.first[1] + y) * rows_.row_pitch + part.first[0],
            (size_t{z} * part.count[1] + y) * part.count[0]);
      }
    }
  }

  void fillUniform(const Part& part, bool full) {
    eachRow(part, [&](size_t to, size_t) {
      if (rows_.bytes != nullptr) {
        std::fill_n(rows_.bytes + to, part.count[0], full ? uint8_t{255} : uint8_t{0});
      } else {
        std::fill_n(rows_.values + to, part.count[0], full ? 1.0f : 0.0f);
      }
    });
  }

  void evaluate(const ProgramView& view, const Part& part) {
    size_t count = 0;
    for (uint32_t z = 0; z < part.count[2]; ++z) {
      for (uint32_t y = 0; y < part.count[1]; ++y) {
        for (uint32_t x = 0; x < part.count[0]; ++x, ++count) {
          x_[count] = coordinate(grid_, 0, part.first[0] + x);
          y_[count] = coordinate(grid_, 1, part.first[1] + y);
          z_[count] = coordinate(grid_, 2, part.first[2] + z);
        }
      }
    }
    bestKernels().samples(view, {x_.data(), y_.data(), z_.data(), count}, evaluation_, q_.data());
    eachRow(part, [&](size_t to, size_t from) {
      const std::span<const int32_t> row(q_.data() + from, part.count[0]);
      if (rows_.bytes != nullptr) {
        densities(row, edge_, rows_.bytes + to);
      } else {
        densities(row, edge_, rows_.values + to);
      }
    });
  }

  const DensityGrid& grid_;
  const DensityEdge& edge_;
  const DensityRows& rows_;
  PruneScratch pruning_;
  std::array<PrunedProgram, kDepths> pruned_;
  EvalScratch evaluation_;
  std::array<int32_t, size_t{kBrick} * kBrick * kBrick> x_{}, y_{}, z_{}, q_{};
};

Result<void> check(const QueryField& field, const DensityGrid& grid) {
  if (!(grid.edge >= 1 && grid.edge <= double{kMaxEdgeCells} * field.finest_cell)) {
    return Error{Code::invalid_argument, "an edge of the density of " + numberText(grid.edge / kUnitsPerMetre) +
                                             " m is out of range: it must be at least one unit wide, and at most " +
                                             std::to_string(kMaxEdgeCells) + " cells of level 0, " +
                                             numberText(double{kMaxEdgeCells} * field.finest_cell / kUnitsPerMetre) +
                                             " m: make the edge narrower, or the cells larger"};
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t steps = int64_t{grid.size[static_cast<size_t>(axis)]} - 1;
    if (steps > (int64_t{INT32_MAX} - grid.origin[axis]) / grid.spacing) {
      return Error{Code::range, "the points leave the world, which ends about 2,097 km from the origin"};
    }
  }
  return {};
}

}  // namespace

Result<DensityFigures> sampleDensity(const QueryField& field, const DensityGrid& grid, JobSystem& jobs,
                                     const DensityRows& rows, const Progress& progress) {
  if (const Result<void> ok = check(field, grid); !ok) return ok.error();
  const DensityEdge edge = densityEdge(grid.edge, field.finest_cell);
  const uint32_t block_edge = field.sampled ? kBrick : kBlock;
  std::pmr::vector<Part> blocks(field.memory);
  cut(Part{{}, grid.size}, block_edge, [&](const Part& block) { blocks.push_back(block); });

  std::mutex mutex;
  DensityFigures figures;
  std::optional<Error> error;
  size_t error_at = 0;
  uint64_t done = 0;
  bool stopped = false;
  // After a failure, the blocks before the failed one are still computed, because the error of the first block that
  // fails is reported.
  const auto ended = [&](size_t i) {
    const std::lock_guard lock(mutex);
    return stopped || (error && i > error_at);
  };
  parallelFor(jobs, blocks.size(), [&](size_t i) {
    if (ended(i)) return;
    const Result<std::shared_ptr<const FieldProgram>> program = field.at(boxOf(grid, blocks[i]));
    BlockFill block(grid, edge, rows, field.memory);
    if (program) block.fill((*program)->view(), blocks[i], block_edge);
    const std::lock_guard lock(mutex);
    if (!program) {
      if (!error || i < error_at) error = program.error(), error_at = i;
      return;
    }
    figures.bricks += block.figures.bricks;
    figures.uniform += block.figures.uniform;
    if (stopped || error || !progress) return;
    // After the last block there is nothing left to cancel, so the result of progress is ignored.
    ++done;
    if (!progress(done, blocks.size()) && done < blocks.size()) stopped = true;
  });
  if (error) return *error;
  if (stopped) return Error{Code::cancelled, "sampling the density was cancelled"};
  return figures;
}

}  // namespace sgm
