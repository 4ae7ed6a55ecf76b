#pragma once
// Kernel that finds which boxes of a chunk contain no surface, and prunes the chunk's programs to each of the other
// boxes. One block per program, one thread per box.

#include "cuda/kernels/batch.h"
#include "cuda/kernels/block.h"
#include "cuda/kernels/field_bounds.h"
#include "cuda/kernels/grid.h"

namespace sgm::cuda {

/// The column of one box in a table: a row belongs to an instruction or a group, a column to a box. The entries of a
/// row are adjacent in memory, so neighbouring threads (which handle neighbouring boxes) make coalesced accesses.
template <class Entry>
struct Column {
  Entry* first;
  uint32_t stride;
  SGM_KERNEL Entry& operator[](size_t i) const { return first[i * stride]; }
};

struct Prune {
  static constexpr uint32_t kThreads = 64;
  struct Shared {
    uint32_t unused;
  };

  template <class Block>
  SGM_KERNEL static void run(Block& block, const Batch& b, Shared&) {
    block.each([&](uint32_t box) {
      const PruneJob& job = b.jobs[block.number()];
      if (box < job.boxes) pruneBox(b, job, box);
    });
  }

  SGM_KERNEL static IntBox boxOf(const Batch& b, const PruneJob& job, uint32_t number) {
    const Chunk& chunk = b.chunks[job.chunk];
    const Int3 origin{chunk.origin[0], chunk.origin[1], chunk.origin[2]};
    IntBox box{origin, origin};
    if (job.kind == PruneJob::bricks) {
      // Bound the field over the brick and one more sample on each side: if the field has one sign there, no edge that
      // starts or ends in the brick has a vertex.
      const Brick brick(number);
      for (int axis = 0; axis < 3; ++axis) {
        const int first = brick.first(axis) - 1, last = brick.last(axis) + 1;
        box.lo[axis] += (first < 0 ? 0 : first) * chunk.cell;
        box.hi[axis] += (last > kChunkCells ? kChunkCells : last) * chunk.cell;
      }
      return box;
    }
    const auto face = static_cast<Face>(b.seams[job.first_seam + number].face);
    for (int axis = 0; axis < 3; ++axis) box.hi[axis] += kChunkCells * chunk.cell;
    const int axis = faceAxis(face);
    if (faceIsHigh(face)) {
      box.lo[axis] = box.hi[axis];
    } else {
      box.hi[axis] = box.lo[axis];
    }
    return box;
  }

  SGM_KERNEL static uint32_t itemOf(const Batch& b, const PruneJob& job, uint32_t number) {
    if (job.kind == PruneJob::bricks) return kBricks * job.chunk + number;
    return planeItem(b, job.first_seam + number, job.kind == PruneJob::coarse_planes);
  }

  SGM_KERNEL static void pruneBox(const Batch& b, const PruneJob& job, uint32_t number) {
    const Program& program = b.programs[job.program];
    const ProgramView view = viewOf(b, program);
    const Column<Mark> marks{b.marks + job.marks + number, job.boxes};
    const Column<GroupBounds> groups{b.bounds + job.bounds + number, job.boxes};
    const IntBox box = boxOf(b, job, number);
    const bounding::FieldBounds bounds = bounding::boundField(view, box, bounding::placesOf(box), marks, groups);

    const uint32_t at = itemOf(b, job, number);
    Item item{};
    item.program = job.program;
    item.initial = bounds.hidden ? kFar : program.initial;
    item.initial_label = bounds.hidden ? 0 : program.initial_label;
    const bool solid = bounds.field.hi * program.q_scale<-0.55f, empty = bounds.field.lo * program.q_scale> - 0.45f;
    item.state = solid ? Item::solid : empty ? Item::empty : Item::mixed;
    const bool sampled = item.state == Item::mixed && isSampled(b, job, number);
    if (sampled || (item.state == Item::mixed && job.kind == PruneJob::own_planes)) keep(b, view, marks, groups, item);
    b.items[at] = item;
    if (item.state == Item::solid) fill(b, job, number);
    if (sampled) b.sampled[addTo(b.head->sampled, 1)] = at;
  }

  /// Writes the pruned program to the pool. If the pool is full, the item uses the whole program, which gives the same
  /// results.
  SGM_KERNEL static void keep(const Batch& b, const ProgramView& view, const Column<Mark>& marks,
                              const Column<GroupBounds>& groups, Item& item) {
    for (size_t g = 0; g < view.groups.size(); ++g) {
      if (!groups[g].live) continue;
      ++item.groups;
      bounding::keepGroup(view, view.groups[g], marks, [&](const Instr&) { ++item.instrs; });
    }
    item.first_instr = addTo(b.head->pool_instrs, item.instrs);
    item.first_group = addTo(b.head->pool_groups, item.groups);
    item.pruned = item.first_instr + item.instrs <= b.pool_instrs_room && item.first_instr <= b.pool_instrs_room &&
                  item.first_group + item.groups <= b.pool_groups_room && item.first_group <= b.pool_groups_room;
    if (!item.pruned) return;
    Instr* const instrs = b.pool_instrs + item.first_instr;
    ProgramGroup* group = b.pool_groups + item.first_group;
    uint32_t first = 0;
    for (size_t g = 0; g < view.groups.size(); ++g) {
      if (!groups[g].live) continue;
      uint32_t count = 0;
      bounding::keepGroup(view, view.groups[g], marks, [&](const Instr&) { ++count; });
      uint32_t next = first + count;
      bounding::keepGroup(view, view.groups[g], marks, [&](const Instr& in) { instrs[--next] = in; });
      *group = view.groups[g];
      group->first = first;
      group->count = count;
      group->guarded = !groups[g].whole;
      ++group;
      first += count;
    }
  }

  SGM_KERNEL static void fill(const Batch& b, const PruneJob& job, uint32_t number) {
    if (job.kind == PruneJob::own_planes) return;
    if (job.kind == PruneJob::coarse_planes) {
      uint32_t* rows = b.coarse_signs + kCoarseSide * (job.first_seam + number);
      for (uint32_t row = 0; row < kCoarseSide; ++row) rows[row] = (1u << kCoarseSide) - 1;
      return;
    }
    const Brick brick(number);
    uint64_t* rows = b.signs + size_t{kRows} * job.chunk;
    for (int z = brick.first(2); z <= brick.last(2); ++z) {
      for (int y = brick.first(1); y <= brick.last(1); ++y) setBits(rows[rowOf(y, z)], brick.bits());
    }
  }

  /// True if the box must be sampled. If only seams are requested, only the bricks at the faces of these seams are
  /// sampled. Of the planes of a seam, only those with the coarser level's field are sampled: the planes with the
  /// chunk's own field only serve vertex attributes.
  SGM_KERNEL static bool isSampled(const Batch& b, const PruneJob& job, uint32_t number) {
    if (job.kind != PruneJob::bricks) return job.kind == PruneJob::coarse_planes;
    const uint32_t faces = b.chunks[job.chunk].faces;
    if (faces == 0) return true;
    const Brick brick(number);
    for (int face = 0; face < 6; ++face) {
      const int axis = face >> 1;
      const bool touches = face & 1 ? brick.last(axis) == kChunkCells : brick.first(axis) == 0;
      if ((faces >> face & 1) != 0 && touches) return true;
    }
    return false;
  }
};

}  // namespace sgm::cuda
