#include "backend/vulkan/batch_plan.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace sgm {

namespace {

constexpr uint32_t kChunkWords = sizeof(batch::Chunk) / 4, kSeamWords = sizeof(batch::Seam) / 4,
                   kJobWords = sizeof(batch::PruneJob) / 4, kHeadWords = sizeof(batch::Head) / 4,
                   kPartWords = sizeof(batch::Part) / 4;
// pruning jobs per chunk: one for its bricks, one for the planes of its seams, and one for these planes with the field
// of the coarser level
constexpr uint32_t kJobsOfChunk = 3;
// Number of words that must follow the last record and the last header, because shaders read them as whole vectors.
constexpr uint32_t kBeyond = 256;
// Maximum number of chunks in a batch. With more chunks, the attributes might need more than 65,535 workgroups, and the
// index of an item more than 20 bits.
constexpr size_t kMaxChunks = 64;

uint32_t seamsOf(const ChunkJob& job) { return job.coarse ? static_cast<uint32_t>(std::popcount(job.seams)) : 0u; }

/// True if the job needs no device: its field programs are constant (have no groups), and the field has the same sign
/// on both sides of every seam.
bool isUniform(const ChunkJob& job) {
  const auto bare = [](const FieldProgram& program) { return program.groups.empty(); };
  return bare(*job.field) && (seamsOf(job) == 0 || (bare(*job.coarse) && job.coarse->initial == job.field->initial));
}

/// Allocates ranges of words in scratch. Every offset is a multiple of four.
class Places {
 public:
  uint32_t take(uint64_t words) {
    const uint64_t at = next_;
    next_ += (words + 3) & ~uint64_t{3};
    return static_cast<uint32_t>(at);
  }
  uint64_t used() const { return next_; }

 private:
  uint64_t next_ = 0;
};

template <class Record>
void put(std::pmr::vector<uint32_t>& words, size_t at, const Record& record) {
  std::memcpy(words.data() + at, &record, sizeof record);
}

/// Builds the plan of one batch.
class Planner {
 public:
  Planner(std::span<const ChunkJob> jobs, const BatchRoom& room, BatchPlan& plan)
      : jobs_(jobs), room_(room), plan_(plan) {
    uint32_t seams = 0;
    for (const ChunkJob& job : jobs) seams += seamsOf(job);
    const auto chunks = static_cast<uint32_t>(jobs.size());
    plan.sizes = {};
    plan.sizes.seam_records = chunks * kChunkWords;
    plan.sizes.jobs = plan.sizes.seam_records + seams * kSeamWords;
    plan.words.assign(plan.sizes.jobs + size_t{kJobsOfChunk} * chunks * kJobWords, 0u);
    plan.parts.assign(kHeadWords, 0u);
    plan.chunks.clear();
    plan.uniform.clear();
    plan.refused.clear();
    plan.seam_count = plan.plane_jobs = 0;
    plan.kinds = 0;
    plan.meshes = plan.sums = false;
  }

  /// Adds job i to the plan. Returns false, without any change, if scratch is too small for the job. must: true adds
  /// the job even if scratch is too small.
  bool add(uint32_t i, uint32_t max_scratch, bool must) {
    const ChunkJob& job = jobs_[i];
    const uint32_t seams = seamsOf(job);
    if (isUniform(job)) {
      plan_.uniform.push_back(i);
      return true;
    }
    const size_t words = plan_.words.size();
    Tape field, coarse;
    if (!append(*job.field, job, field) || (seams > 0 && !append(*job.coarse, job, coarse))) {
      plan_.words.resize(words);
      plan_.refused.push_back(i);
      return true;
    }
    const Places before = places_;
    place(i, field, coarse);
    if (!must && scratchWords() > max_scratch) {
      places_ = before;
      plan_.words.resize(words);
      undo(seams);
      return false;
    }
    plan_.kinds |= field.kinds | coarse.kinds;
    (job.sums_only ? plan_.sums : plan_.meshes) = true;
    return true;
  }

  void finish() {
    const auto chunks = static_cast<uint32_t>(plan_.chunks.size());
    const uint32_t bricks = chunks * batch::kBricks, planes = 2 * plan_.seam_count;
    batch::Sizes& s = plan_.sizes;
    s.part_count = part_count_;
    if (plan_.sums) plan_.parts.resize(plan_.parts.size() + size_t{part_count_} * (sizeof(batch::Sums) / 4), 0u);
    plan_.plane_jobs_at = s.jobs + static_cast<uint32_t>(jobs_.size()) * kJobWords;
    s.chunk_count = chunks;
    s.max_vertices = room_.vertices * std::max(chunks, 8u);
    s.max_indices = room_.indices * std::max(chunks, 8u);
    s.max_cells = room_.cells * std::max(chunks, 8u);
    s.items = places_.take(uint64_t{bricks + planes} * batch::kItemWords);
    s.sampled = places_.take(uint64_t{bricks + planes} * batch::kMaxSlices);
    s.units = places_.take(unitWords(s.max_vertices, bricks + planes));
    s.entries = places_.take(s.max_vertices);
    s.cell_list = places_.take(uint64_t{s.max_cells} * batch::kCellWords);
    plan_.scratch_words = static_cast<uint32_t>(places_.used());
    for (uint32_t c = 0; c < chunks; ++c) plan_.chunks[c].item = s.items + c * batch::kBricks * batch::kItemWords;
    plan_.words.resize(plan_.words.size() + kBeyond, 0u);
  }

 private:
  /// Appends the program's tape. If this tape exceeds a limit of the shaders, prunes the program to the chunk and
  /// appends the tape of the pruned program instead. Returns false if that tape exceeds a limit, too.
  bool append(const FieldProgram& program, const ChunkJob& job, Tape& tape) {
    if (appendTape(program.view(), plan_.tape_scratch, plan_.words, tape)) return true;
    IntBox box{job.grid.origin, job.grid.origin};
    for (int axis = 0; axis < 3; ++axis) box.hi[axis] += kChunkCells * job.grid.cell;
    prune(program.view(), box, plan_.prune_scratch, plan_.pruned);
    const bool solid = plan_.pruned.solid();
    if (!solid && !plan_.pruned.empty()) {
      return appendTape(plan_.pruned.view(), plan_.tape_scratch, plan_.words, tape);
    }
    // Pruning shows that the chunk is uniform, so the chunk itself needs no groups. But for the vertices of seams the
    // whole program would be needed, and its tape exceeds a limit.
    if (seamsOf(job) > 0) return false;
    ProgramView uniform;
    uniform.initial = solid ? -kFar : kFar;
    uniform.q_scale = program.q_scale;
    return appendTape(uniform, plan_.tape_scratch, plan_.words, tape);
  }

  /// Returns an upper bound of the number of words for units. A unit has at least as many vertices as a subgroup has
  /// invocations, which is at least 8; only the last unit of each item may have fewer.
  static uint64_t unitWords(uint64_t vertices, uint64_t items) { return (vertices / 8 + items) * batch::kUnitWords; }

  uint64_t scratchWords() const {
    const uint64_t chunks = std::max<uint64_t>(plan_.chunks.size(), 8);
    return places_.used() +
           chunks * (batch::kBricks * (batch::kItemWords + batch::kMaxSlices + batch::kUnitWords) + room_.vertices * 2 +
                     uint64_t{room_.cells} * batch::kCellWords) +
           uint64_t{plan_.seam_count} * 2 * (batch::kItemWords + batch::kMaxSlices + batch::kUnitWords);
  }

  uint32_t newPart(bool body) {
    batch::Part part{};
    part.middle = body ? batch::kNoRoom : 0;
    const size_t at = plan_.parts.size();
    plan_.parts.resize(at + kPartWords);
    put(plan_.parts, at, part);
    return part_count_++;
  }

  void addJob(batch::PruneJob::Kind kind, uint32_t chunk, uint32_t first_seam, uint32_t seams, const Tape& tape) {
    batch::PruneJob job{};
    job.headers = tape.headers;
    job.records = tape.records;
    job.kind = kind;
    job.chunk = chunk;
    job.first_seam = first_seam;
    job.seam_count = seams;
    job.lists = places_.take(uint64_t{tape.records} * (kind == batch::PruneJob::bricks ? batch::kBricks : seams));
    job.initial = tape.initial;
    job.initial_label = tape.initial_label;
    job.q_scale = tape.q_scale;
    const size_t number = kind == batch::PruneJob::bricks ? chunk : jobs_.size() + plan_.plane_jobs++;
    put(plan_.words, plan_.sizes.jobs + number * kJobWords, job);
  }

  void place(uint32_t i, const Tape& field, const Tape& coarse) {
    const ChunkJob& job = jobs_[i];
    const auto number = static_cast<uint32_t>(plan_.chunks.size());
    BatchPlan::Chunk& planned = plan_.chunks.emplace_back();
    planned.job = i;
    planned.seams.fill(batch::kNoRoom);
    batch::Chunk chunk{};
    for (int axis = 0; axis < 3; ++axis) chunk.origin[axis] = job.grid.origin[axis];
    chunk.cell = job.grid.cell;
    chunk.samples = places_.take(batch::kSampleWords);
    chunk.signs = planned.signs = places_.take(batch::kSignWords);
    chunk.rows = places_.take(batch::kRowsWords);
    chunk.part = planned.body = job.body ? newPart(true) : batch::kNoRoom;
    chunk.faces = job.body ? 0u : job.seams;
    put(plan_.words, size_t{number} * kChunkWords, chunk);
    addJob(batch::PruneJob::bricks, number, 0, 0, field);

    const uint32_t seams = seamsOf(job);
    if (seams == 0) return;
    const uint32_t first = plan_.seam_count;
    for (uint32_t face = 0; face < 6; ++face) {
      if ((job.seams >> face & 1) == 0) continue;
      batch::Seam seam{};
      seam.chunk = number;
      seam.face = face;
      seam.samples = places_.take(batch::kCoarseSampleWords);
      seam.signs = places_.take(batch::kCoarseSignWords);
      seam.counts = places_.take(batch::kSeamCountWords);
      seam.part = planned.seams[face] = newPart(false);
      put(plan_.words, plan_.sizes.seam_records + size_t{plan_.seam_count} * kSeamWords, seam);
      ++plan_.seam_count;
    }
    addJob(batch::PruneJob::own_planes, number, first, seams, field);
    addJob(batch::PruneJob::coarse_planes, number, first, seams, coarse);
  }

  void undo(uint32_t seams) {
    const uint32_t parts = seams + (plan_.chunks.back().body != batch::kNoRoom ? 1 : 0);
    part_count_ -= parts;
    plan_.parts.resize(plan_.parts.size() - size_t{parts} * kPartWords);
    plan_.chunks.pop_back();
    plan_.seam_count -= seams;
    plan_.plane_jobs -= seams > 0 ? 2 : 0;
  }

  std::span<const ChunkJob> jobs_;
  const BatchRoom& room_;
  BatchPlan& plan_;
  Places places_;
  uint32_t part_count_ = 0;
};

}  // namespace

size_t planBatch(std::span<const ChunkJob> jobs, const BatchRoom& room, uint32_t max_scratch, BatchPlan& plan) {
  Planner planner(jobs, room, plan);
  uint32_t taken = 0;
  while (taken < std::min(jobs.size(), kMaxChunks) && planner.add(taken, max_scratch, plan.chunks.empty())) ++taken;
  planner.finish();
  return taken;
}

}  // namespace sgm
