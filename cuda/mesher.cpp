#include "cuda/mesher.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "cuda/kernels/emit_body.h"
#include "cuda/kernels/sums.h"

namespace sgm::cuda {

namespace {

/// Number of blocks per multiprocessor for kernels whose amount of work is known only on the device. It is large enough
/// to keep all multiprocessors busy.
constexpr uint32_t kBlocksAProcessor = 32;

/// Places arrays one after the other in one memory block. A first pass, without a block, computes the total size; a
/// second pass sets the addresses.
class Places {
 public:
  explicit Places(std::byte* begin) : begin_(begin) {}
  template <class Entry>
  void put(Entry*& array, uint64_t count) {
    if (begin_ != nullptr) array = reinterpret_cast<Entry*>(begin_ + used_);
    used_ += (count * sizeof(Entry) + kAlignment - 1) / kAlignment * kAlignment;
  }
  size_t used() const { return used_; }

 private:
  std::byte* const begin_;
  size_t used_ = 0;
};

size_t placeResult(const Plan& plan, std::byte* begin, Head*& head, Part*& parts, Sums*& sums) {
  Places places(begin);
  places.put(head, 1);
  places.put(parts, plan.part_count);
  if (plan.sums) places.put(sums, plan.part_count);
  return places.used();
}

/// Lays out the input arrays; if `staging` is not null, also copies them there. Returns their total size in bytes.
size_t placeInput(const Plan& plan, std::byte* staging, std::byte* device, Batch& batch) {
  Places to(staging), at(device);
  const auto put = [&](const auto& array, auto*& on_device) {
    using Entry = typename std::remove_reference_t<decltype(array)>::value_type;
    Entry* copy = nullptr;
    Entry* place = nullptr;
    to.put(copy, array.size());
    at.put(place, array.size());
    if (copy != nullptr && !array.empty())
      std::memcpy(static_cast<void*>(copy), array.data(), array.size() * sizeof(Entry));
    on_device = place;
  };
  put(plan.instrs, batch.instrs);
  put(plan.params, batch.params);
  put(plan.groups, batch.groups);
  put(plan.programs, batch.programs);
  put(plan.chunks, batch.chunks);
  put(plan.seams, batch.seams);
  put(plan.jobs, batch.jobs);
  return to.used();
}

size_t placeScratch(const Plan& plan, std::byte* begin, Batch& batch) {
  const uint64_t chunks = plan.chunks.size(), seams = plan.seams.size(), items = chunks * kBricks + 2 * seams;
  Places places(begin);
  // Arrays that must be zeroed come first, so that a single call clears them.
  places.put(batch.signs, chunks * kRows);
  places.put(batch.coarse_signs, seams * kCoarseSide);
  places.put(batch.marks, plan.marks);
  places.put(batch.bounds, plan.bounds);
  places.put(batch.items, items);
  places.put(batch.pool_instrs, batch.pool_instrs_room);
  places.put(batch.pool_groups, batch.pool_groups_room);
  places.put(batch.sampled, items);
  places.put(batch.samples, chunks * kSamples);
  places.put(batch.coarse_samples, seams * kCoarsePlane);
  places.put(batch.rows, chunks * kRows);
  places.put(batch.cells, chunks * kCells);
  places.put(batch.seam_census, seams);
  return places.used();
}

/// Returns the number of bytes at the beginning of scratch that must be zeroed.
size_t zeroBytes(const Plan& plan) {
  Batch batch{};
  Places places(nullptr);
  places.put(batch.signs, plan.chunks.size() * kRows);
  places.put(batch.coarse_signs, plan.seams.size() * kCoarseSide);
  return places.used();
}

uint64_t signBytes(const Plan& plan) { return plan.chunks.size() * uint64_t{kRows} * sizeof(uint64_t); }

}  // namespace

Result<std::unique_ptr<Mesher>> Mesher::create(Device& device, const Room& room) {
  std::unique_ptr<Mesher> mesher(new Mesher(device, room));
  if (Result<void> made = mesher->makeTables(); !made) return made.error();
  return mesher;
}

Result<void> Mesher::makeTables() {
  Result<std::unique_ptr<Stream>> stream = device_.makeStream();
  if (!stream) return stream.error();
  stream_ = std::move(*stream);
  Memory pinned;
  if (Result<void> grown = pinned.grow(*stream_, MemoryKind::pinned, sizeof(CaseTables)); !grown) return grown;
  if (Result<void> grown = tables_.grow(*stream_, MemoryKind::device, sizeof(CaseTables)); !grown) return grown;
  auto& tables = *new (pinned.data()) CaseTables;
  std::copy(std::begin(kCubeLoopStart), std::end(kCubeLoopStart), tables.cube_start);
  std::copy(std::begin(kCubeLoops), std::end(kCubeLoops), tables.cube_loops);
  std::copy(std::begin(kCubeTriangles), std::end(kCubeTriangles), tables.cube_triangles);
  std::copy(std::begin(kCubeEdgeFaces), std::end(kCubeEdgeFaces), tables.cube_edge_faces);
  std::copy(std::begin(kSeamLoopStart), std::end(kSeamLoopStart), tables.seam_start);
  std::copy(std::begin(kSeamLoops), std::end(kSeamLoops), tables.seam_loops);
  std::copy(std::begin(kSeamTriangles), std::end(kSeamTriangles), tables.seam_triangles);
  std::copy(std::begin(kSeamEdgeFaces), std::end(kSeamEdgeFaces), tables.seam_edge_faces);
  if (Result<void> copied = stream_->copyIn(tables_.data(), pinned.data(), sizeof tables); !copied) return copied;
  return stream_->wait();
}

Batch Mesher::sized(const Plan& plan) const {
  Batch batch{};
  batch.tables = reinterpret_cast<const CaseTables*>(tables_.data());
  batch.chunk_count = static_cast<uint32_t>(plan.chunks.size());
  batch.seam_count = static_cast<uint32_t>(plan.seams.size());
  batch.job_count = static_cast<uint32_t>(plan.jobs.size());
  batch.part_count = plan.part_count;
  batch.meshes = plan.meshes;
  const PoolSize pool = poolOf(plan.marks, plan.bounds, room_);
  batch.pool_instrs_room = static_cast<uint32_t>(pool.instrs);
  batch.pool_groups_room = static_cast<uint32_t>(pool.groups);
  batch.vertices_room = room_.vertices * std::max(batch.chunk_count, 8u);
  batch.indices_room = room_.indices * std::max(batch.chunk_count, 8u);
  return batch;
}

/// Allocates all memory of a batch, and lays out its arrays.
Result<void> Mesher::fit(const Plan& plan, BatchMemory& m, Batch& batch) const {
  m.input_bytes = placeInput(plan, nullptr, nullptr, batch);
  m.result_bytes = placeResult(plan, nullptr, batch.head, batch.parts, batch.sums);
  m.brought_vertices = m.brought_indices = 0;
  if (plan.meshes) {
    m.brought_vertices = std::min<uint64_t>(usual_vertices_.load(), batch.vertices_room * uint64_t{sizeof(Vertex)});
    m.brought_indices = std::min<uint64_t>(usual_indices_.load(), batch.indices_room * uint64_t{sizeof(uint32_t)});
  }
  const struct {
    Memory& memory;
    MemoryKind kind;
    uint64_t bytes;
  } needs[] = {
      {m.staging, MemoryKind::pinned, m.input_bytes},
      {m.input, MemoryKind::device, m.input_bytes},
      {m.scratch, MemoryKind::device, placeScratch(plan, nullptr, batch)},
      {m.result, MemoryKind::device, m.result_bytes},
      {m.vertices, MemoryKind::device, batch.vertices_room * uint64_t{sizeof(Vertex)}},
      {m.indices, MemoryKind::device, batch.indices_room * uint64_t{sizeof(uint32_t)}},
      {m.result_back, MemoryKind::pinned, m.result_bytes},
      {m.signs_back, MemoryKind::pinned, signBytes(plan)},
      {m.vertices_back, MemoryKind::pinned, m.brought_vertices},
      {m.indices_back, MemoryKind::pinned, m.brought_indices},
  };
  for (const auto& need : needs) {
    if (Result<void> grown = need.memory.grow(*m.stream, need.kind, need.bytes); !grown) return grown;
  }
  placeInput(plan, m.staging.data(), m.input.data(), batch);
  placeScratch(plan, m.scratch.data(), batch);
  placeResult(plan, m.result.data(), batch.head, batch.parts, batch.sums);
  batch.vertices = reinterpret_cast<Vertex*>(m.vertices.data());
  batch.indices = reinterpret_cast<uint32_t*>(m.indices.data());
  return {};
}

Mesher::Launches Mesher::launches(const Batch& batch) const {
  const uint32_t items = kBricks * batch.chunk_count + 2 * batch.seam_count;
  const uint32_t of_list = std::min(items, device_.info().processors * kBlocksAProcessor);
  return {{
      {Kernel::Prune, batch.job_count},
      {Kernel::Sample, of_list},
      {Kernel::CensusBody, batch.chunk_count},
      {Kernel::CensusSeam, batch.seam_count},
      {Kernel::Allocate, 1},
      {Kernel::BodyVertices, of_list},
      {Kernel::SeamVertices, batch.seam_count},
      {Kernel::ListCells, batch.chunk_count},
      {Kernel::BodyTriangles, batch.chunk_count * BodyTriangles::kSlices},
      {Kernel::SeamTriangles, batch.seam_count},
      {Kernel::SumTriangles, batch.sums != nullptr ? batch.part_count * SumTriangles::kSlices : 0},
  }};
}

Result<void> Mesher::run(Stream& stream, const Launches& launches, const Batch& batch) {
  for (const Launch& launch : launches) {
    if (launch.blocks == 0) continue;
    if (Result<void> launched = stream.launch(launch.kernel, launch.blocks, batch); !launched) return launched;
  }
  return {};
}

Result<void> Mesher::download(const Plan& plan, BatchMemory& m, const Batch& batch) const {
  const struct {
    const Memory& to;
    const void* from;
    uint64_t bytes;
  } copies[] = {
      {m.result_back, batch.head, m.result_bytes},
      {m.signs_back, batch.signs, signBytes(plan)},
      {m.vertices_back, batch.vertices, m.brought_vertices},
      {m.indices_back, batch.indices, m.brought_indices},
  };
  for (const auto& copy : copies) {
    if (copy.bytes == 0) continue;
    if (Result<void> copied = m.stream->copyOut(copy.to.data(), copy.from, copy.bytes); !copied) return copied;
  }
  return {};
}

Result<Batch> Mesher::load(const Plan& plan, BatchMemory& m) {
  if (!m.stream) {
    Result<std::unique_ptr<Stream>> made = device_.makeStream(StreamUse::batches);
    if (!made) return made.error();
    m.stream = std::move(*made);
  }
  Batch batch = sized(plan);
  if (Result<void> fits = fit(plan, m, batch); !fits) return fits.error();
  Result<void> copied = m.stream->copyIn(m.input.data(), m.staging.data(), m.input_bytes);
  if (!copied) return copied.error();
  return batch;
}

Result<void> Mesher::clear(const Plan& plan, BatchMemory& m) const {
  if (Result<void> cleared = m.stream->clear(m.scratch.data(), zeroBytes(plan)); !cleared) return cleared;
  return m.stream->clear(m.result.data(), m.result_bytes);
}

Result<void> Mesher::submit(const Plan& plan, BatchMemory& m) {
  const Result<Batch> batch = load(plan, m);
  if (!batch) return batch.error();
  if (Result<void> cleared = clear(plan, m); !cleared) return cleared;
  if (Result<void> ran = run(*m.stream, launches(*batch), *batch); !ran) return ran;
  if (Result<void> brought = download(plan, m, *batch); !brought) return brought;
  return m.stream->mark();
}

Result<Stream*> Mesher::reading(BatchMemory& m) {
  if (!m.reading) {
    Result<std::unique_ptr<Stream>> made = device_.makeStream();
    if (!made) return made.error();
    m.reading = std::move(*made);
  }
  return m.reading.get();
}

Result<Mesher::Output> Mesher::read(const Plan& plan, BatchMemory& m) {
  Head* head = nullptr;
  Part* parts = nullptr;
  Sums* sums = nullptr;
  placeResult(plan, m.result_back.data(), head, parts, sums);
  if (plan.meshes) {
    if (Result<void> brought = downloadRest(*head, m); !brought) return brought.error();
  }
  return Output{parts, sums, reinterpret_cast<const Vertex*>(m.vertices_back.data()),
                reinterpret_cast<const uint32_t*>(m.indices_back.data()),
                reinterpret_cast<const uint64_t*>(m.signs_back.data())};
}

/// Downloads all vertices and indices if the batch has more of them than it downloaded by itself.
Result<void> Mesher::downloadRest(const Head& head, BatchMemory& m) {
  const uint64_t vertices = uint64_t{head.vertices} * sizeof(Vertex),
                 indices = uint64_t{head.indices} * sizeof(uint32_t);
  // Successive batches are similar, so the next download gets a quarter more than this batch had.
  usual_vertices_.store(vertices + vertices / 4);
  usual_indices_.store(indices + indices / 4);
  if (vertices <= m.brought_vertices && indices <= m.brought_indices) return {};
  const Result<Stream*> stream = reading(m);
  if (!stream) return stream.error();
  if (Result<void> grown = m.vertices_back.grow(*m.stream, MemoryKind::pinned, vertices); !grown) return grown;
  if (Result<void> grown = m.indices_back.grow(*m.stream, MemoryKind::pinned, indices); !grown) return grown;
  if (Result<void> copied = (*stream)->copyOut(m.vertices_back.data(), m.vertices.data(), vertices); !copied)
    return copied;
  if (Result<void> copied = (*stream)->copyOut(m.indices_back.data(), m.indices.data(), indices); !copied)
    return copied;
  return (*stream)->wait();
}

}  // namespace sgm::cuda
