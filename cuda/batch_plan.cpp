#include "cuda/batch_plan.h"

#include <algorithm>
#include <bit>

namespace sgm::cuda {

namespace {

/// Appends to `params` a copy of a lattice op's parameters, then the lattice's smallest and largest sample. From these
/// two, a kernel computes bounds of the op's value.
uint32_t appendLattice(const uint32_t* p, uint32_t first_param, std::pmr::vector<uint32_t>& params) {
  const size_t points = size_t{p[5]} * p[6] * p[7], at = params.size();
  params.insert(params.end(), p, p + 10 + points);
  float lo = std::bit_cast<float>(p[10]), hi = lo;
  for (size_t i = 0; i < points; ++i) {
    lo = std::min(lo, std::bit_cast<float>(p[10 + i]));
    hi = std::max(hi, std::bit_cast<float>(p[10 + i]));
  }
  params.push_back(std::bit_cast<uint32_t>(lo));
  params.push_back(std::bit_cast<uint32_t>(hi));
  return static_cast<uint32_t>(at) - first_param;
}

uint64_t scratchBytes(uint64_t chunks, uint64_t seams, uint64_t marks, uint64_t bounds, const Room& room) {
  const PoolSize pool = poolOf(marks, bounds, room);
  return marks * sizeof(Mark) + bounds * sizeof(GroupBounds) + pool.instrs * sizeof(Instr) +
         pool.groups * sizeof(ProgramGroup) + (chunks * kBricks + 2 * seams) * (sizeof(Item) + sizeof(uint32_t)) +
         chunks * (kSamples * sizeof(int32_t) + kRows * (sizeof(uint64_t) + sizeof(Row)) + kCells * sizeof(Cell)) +
         seams * (sizeof(SeamCensus) + (kCoarsePlane + kCoarseSide) * sizeof(uint32_t));
}

class Planner {
 public:
  Planner(const Room& room, Plan& plan) : room_(room), plan_(plan) {
    plan.instrs.clear();
    plan.params.clear();
    plan.groups.clear();
    plan.programs.clear();
    plan.chunks.clear();
    plan.seams.clear();
    plan.jobs.clear();
    plan.chunks_of.clear();
    plan.uniform.clear();
    plan.part_count = 0;
    plan.marks = plan.bounds = 0;
  }

  /// Adds the job to the plan. Returns false and changes nothing if the plan would then need more scratch memory than
  /// the limit; the plan's first chunk is always added.
  bool add(const ChunkJob& job, uint32_t number) {
    const uint32_t seams = job.seams == 0 ? 0 : static_cast<uint32_t>(std::popcount(unsigned{job.seams} & 63u));
    if (isUniform(job, seams)) {
      plan_.uniform.push_back(number);
      return true;
    }
    const uint64_t marks = plan_.marks + entriesOf(job, seams, [](const FieldProgram& p) { return p.instrs.size(); });
    const uint64_t bounds = plan_.bounds + entriesOf(job, seams, [](const FieldProgram& p) { return p.groups.size(); });
    // The factor 2: appendLattice stores the parameters of lattices, which may be large, a second time.
    const uint64_t params =
        plan_.params.size() + 2 * job.field->params.size() + (seams > 0 ? 2 * job.coarse->params.size() : 0);
    const uint64_t needed = params * sizeof(uint32_t) +
                            scratchBytes(plan_.chunks.size() + 1, plan_.seams.size() + seams, marks, bounds, room_);
    if (!plan_.chunks.empty() && needed > room_.scratch_bytes) return false;
    place(job, number, seams);
    return true;
  }

 private:
  static bool isUniform(const ChunkJob& job, uint32_t seams) {
    if (!job.field->groups.empty()) return false;
    // Here the chunk's own field is constant. If no seams are requested, that suffices. Otherwise the coarser field
    // must be constant too, with the same sign: if it is not, the surface passes through the seam between the two
    // levels of detail.
    return seams == 0 || (job.coarse->groups.empty() && (job.coarse->initial < 0) == (job.field->initial < 0));
  }

  template <class Size>
  static uint64_t entriesOf(const ChunkJob& job, uint32_t seams, const Size& size) {
    return (kBricks + seams) * uint64_t{size(*job.field)} + (seams > 0 ? seams * uint64_t{size(*job.coarse)} : 0);
  }

  uint32_t addProgram(const FieldProgram& field) {
    Program program{};
    program.first_instr = static_cast<uint32_t>(plan_.instrs.size());
    program.instrs = static_cast<uint32_t>(field.instrs.size());
    program.first_param = static_cast<uint32_t>(plan_.params.size());
    program.first_group = static_cast<uint32_t>(plan_.groups.size());
    program.groups = static_cast<uint32_t>(field.groups.size());
    program.initial = field.initial;
    program.initial_label = field.initial_label;
    program.q_scale = field.q_scale;
    plan_.instrs.insert(plan_.instrs.end(), field.instrs.begin(), field.instrs.end());
    plan_.params.insert(plan_.params.end(), field.params.begin(), field.params.end());
    plan_.groups.insert(plan_.groups.end(), field.groups.begin(), field.groups.end());
    for (size_t i = program.first_instr; i < plan_.instrs.size(); ++i) {
      Instr& in = plan_.instrs[i];
      if (in.op != Op::lattice) continue;
      in.params = appendLattice(field.params.data() + in.params, program.first_param, plan_.params);
    }
    program.params = static_cast<uint32_t>(plan_.params.size()) - program.first_param;
    plan_.programs.push_back(program);
    return static_cast<uint32_t>(plan_.programs.size() - 1);
  }

  void addJob(PruneJob::Kind kind, uint32_t chunk, uint32_t program, uint32_t first_seam, uint32_t boxes) {
    const Program& p = plan_.programs[program];
    plan_.jobs.push_back({kind, chunk, program, first_seam, boxes, plan_.marks, plan_.bounds});
    plan_.marks += uint64_t{boxes} * p.instrs;
    plan_.bounds += uint64_t{boxes} * p.groups;
  }

  void place(const ChunkJob& job, uint32_t number, uint32_t seams) {
    const auto at = static_cast<uint32_t>(plan_.chunks.size());
    Plan::Parts& parts = plan_.chunks_of.emplace_back();
    parts.job = number;
    (job.sums_only ? plan_.sums : plan_.meshes) = true;
    parts.body = job.body ? plan_.part_count++ : kNone;
    parts.seams.fill(kNone);
    Chunk chunk{};
    for (int axis = 0; axis < 3; ++axis) chunk.origin[axis] = job.grid.origin[axis];
    chunk.cell = job.grid.cell;
    chunk.body = parts.body;
    chunk.faces = job.body ? 0 : job.seams;
    plan_.chunks.push_back(chunk);
    const uint32_t field = addProgram(*job.field);
    addJob(PruneJob::bricks, at, field, 0, kBricks);
    if (seams == 0) return;
    const auto first_seam = static_cast<uint32_t>(plan_.seams.size());
    for (uint32_t face = 0; face < 6; ++face) {
      if ((job.seams >> face & 1) == 0) continue;
      parts.seams[face] = plan_.part_count++;
      plan_.seams.push_back({at, face, parts.seams[face]});
    }
    addJob(PruneJob::own_planes, at, field, first_seam, seams);
    addJob(PruneJob::coarse_planes, at, addProgram(*job.coarse), first_seam, seams);
  }

  const Room& room_;
  Plan& plan_;
};

}  // namespace

PoolSize poolOf(uint64_t marks, uint64_t bounds, const Room& room) {
  const uint64_t bytes = marks * sizeof(Instr) + bounds * sizeof(ProgramGroup);
  if (bytes <= room.pool_bytes) return {marks, bounds};
  const double share = static_cast<double>(room.pool_bytes) / static_cast<double>(bytes);
  return {static_cast<uint64_t>(static_cast<double>(marks) * share),
          static_cast<uint64_t>(static_cast<double>(bounds) * share)};
}

size_t planBatch(std::span<const ChunkJob> jobs, const Room& room, Plan& plan) {
  Planner planner(room, plan);
  uint32_t taken = 0;
  while (taken < jobs.size() && taken < kMaxChunks && planner.add(jobs[taken], taken)) ++taken;
  return taken;
}

}  // namespace sgm::cuda
