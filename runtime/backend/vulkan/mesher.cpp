#include "backend/vulkan/mesher.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "backend/vulkan/case_tables.h"

namespace sgm::vulkan {

namespace {

constexpr uint32_t kHeadSize = sizeof(batch::Head);
constexpr uint32_t kSumSlices = 4;  // number of workgroups that add up the triangles of a part

/// Keeps the buffer if it has at least this many bytes; otherwise replaces it by a larger buffer.
Result<void> grow(Memory& memory, MemoryKind kind, uint64_t bytes, Buffer& buffer) {
  bytes = std::max<uint64_t>(bytes, 256);
  if (buffer && buffer.size() >= bytes) return {};
  buffer = Buffer();
  Result<Buffer> made = memory.buffer(kind, bytes + bytes / 4);
  if (!made) return made.error();
  buffer = std::move(*made);
  return {};
}

}  // namespace

uint32_t Mesher::maxScratchWords() const {
  const uint64_t range = std::min<uint64_t>(queue_.device().limits().maxStorageBufferRange, uint64_t{128} << 20);
  // Only three quarters of the range: grow() makes a buffer up to a quarter larger than requested.
  return static_cast<uint32_t>(range / sizeof(uint32_t) / 4 * 3);
}

Result<std::unique_ptr<Mesher>> Mesher::create(Queue& queue, Memory& memory, CommandRing& ring, Kernels& kernels) {
  std::unique_ptr<Mesher> mesher(new Mesher(queue, memory, ring, kernels));
  const std::vector<uint32_t> tables = caseTables();
  const uint64_t bytes = tables.size() * sizeof(uint32_t);
  Result<Buffer> buffer = memory.buffer(MemoryKind::upload, bytes);
  if (!buffer) return buffer.error();
  std::memcpy(buffer->data(), tables.data(), bytes);
  mesher->tables_ = std::move(*buffer);
  return mesher;
}

Result<void> Mesher::fit(const BatchPlan& plan, BatchBuffers& b) {
  const uint64_t words = plan.words.size() * sizeof(uint32_t), parts = plan.parts.size() * sizeof(uint32_t);
  const struct {
    MemoryKind kind;
    uint64_t bytes;
    Buffer* buffer;
  } needs[] = {
      {MemoryKind::device, words, &b.words},
      {MemoryKind::device, uint64_t{plan.scratch_words} * sizeof(uint32_t), &b.scratch},
      {MemoryKind::device, parts, &b.parts},
      {MemoryKind::device, uint64_t{plan.sizes.max_vertices} * sizeof(Vertex), &b.vertices},
      {MemoryKind::device, uint64_t{plan.sizes.max_indices} * sizeof(uint32_t), &b.indices},
  };
  for (const auto& need : needs) {
    if (Result<void> grown = grow(memory_, need.kind, need.bytes, *need.buffer); !grown) return grown.error();
  }
  if (b.words.data() != nullptr) return {};
  if (Result<void> grown = grow(memory_, MemoryKind::upload, words + parts, b.staging); !grown) return grown.error();
  return fitBack(plan, b);
}

Result<void> Mesher::fitBack(const BatchPlan& plan, BatchBuffers& b) {
  b.brought_vertices = b.brought_indices = 0;
  if (plan.meshes) {
    b.brought_vertices = std::min<uint64_t>(usual_vertices_.load(), plan.sizes.max_vertices * uint64_t{sizeof(Vertex)});
    b.brought_indices = std::min<uint64_t>(usual_indices_.load(), plan.sizes.max_indices * uint64_t{sizeof(uint32_t)});
  }
  const struct {
    uint64_t bytes;
    Buffer* buffer;
  } needs[] = {
      {plan.parts.size() * sizeof(uint32_t), &b.parts_back},
      {plan.chunks.size() * uint64_t{batch::kSignWords} * sizeof(uint32_t), &b.signs_back},
      {b.brought_vertices, &b.vertices_back},
      {b.brought_indices, &b.indices_back},
  };
  for (const auto& need : needs) {
    if (Result<void> grown = grow(memory_, MemoryKind::readback, need.bytes, *need.buffer); !grown)
      return grown.error();
  }
  return {};
}

Result<void> Mesher::record(Commands& commands, const Pipelines& pipelines, const BatchPlan& plan, BatchBuffers& b) {
  const std::array<BufferRange, kKernelBuffers> ranges{b.words, b.scratch, b.parts, b.vertices, b.indices, tables_};
  batch::Sizes sizes = plan.sizes;
  Result<void> bound;
  // Kernels run one after the other, even where two could overlap: each one fills the whole device, and the
  // dependencies stay simple for readers and for the validation layer.
  const auto run = [&](Kernel kernel, const auto& dispatch) {
    if (bound) bound = commands.bind(*pipelines[kernel], ranges, std::as_bytes(std::span(&sizes, 1)));
    if (!bound) return;
    dispatch();
    commands.barrier(kCompute, kCompute | kIndirect);
  };
  const auto direct = [&](Kernel kernel, uint32_t x, uint32_t y = 1) {
    if (x > 0) run(kernel, [&] { commands.dispatch(x, y); });
  };
  const auto indirect = [&](Kernel kernel, const BufferRange& counts) {
    run(kernel, [&] { commands.dispatchIndirect(counts); });
  };
  const BufferRange sampled(b.parts, offsetof(batch::Head, sampled), 3 * sizeof(uint32_t));
  const BufferRange units(b.parts, offsetof(batch::Head, units), 3 * sizeof(uint32_t));
  const BufferRange cells(b.parts, offsetof(batch::Head, dispatch), 3 * sizeof(uint32_t));
  const auto chunks = static_cast<uint32_t>(plan.chunks.size());

  direct(prune, chunks, batch::kBricks / kernels_.width());
  sizes.jobs = plan.plane_jobs_at;
  direct(prune, plan.plane_jobs);
  sizes.jobs = plan.sizes.jobs;
  indirect(refine, sampled);
  direct(fill_signs, chunks + plan.seam_count);
  indirect(sample, sampled);
  direct(census_body, chunks);
  direct(census_seam, plan.seam_count);
  direct(allocate, 1);
  indirect(body_vertices, sampled);
  direct(seam_vertices, plan.seam_count);
  if (plan.meshes) {
    direct(plane_units, plan.seam_count);
    indirect(attributes, units);
  }
  direct(list_cells, chunks);
  indirect(triangles, cells);
  direct(seam_triangles, plan.seam_count);
  if (plan.sums) direct(sums, plan.sizes.part_count, kSumSlices);
  return bound;
}

Result<uint64_t> Mesher::submit(const BatchPlan& plan, BatchBuffers& b) {
  Result<Pipelines> pipelines = kernels_.get(plan.kinds);
  if (!pipelines) return pipelines.error();
  if (Result<void> fits = fit(plan, b); !fits) return fits.error();
  Result<Commands> commands = ring_.begin();
  if (!commands) return commands.error();
  const uint64_t words = plan.words.size() * sizeof(uint32_t), parts = plan.parts.size() * sizeof(uint32_t);
  const bool seen = b.words.data() != nullptr;
  std::memcpy(seen ? b.words.data() : b.staging.data(), plan.words.data(), words);
  std::memcpy(seen ? b.parts.data() : b.staging.data() + words, plan.parts.data(), parts);
  batch::Head head{};
  head.sampled[1] = head.sampled[2] = head.units[1] = head.units[2] = 1;
  std::memcpy(seen ? b.parts.data() : b.staging.data() + words, &head, sizeof head);
  if (!seen) {
    commands->copy(BufferRange(b.staging, 0, words), BufferRange(b.words, 0, words));
    commands->copy(BufferRange(b.staging, words, parts), BufferRange(b.parts, 0, parts));
    commands->barrier(kTransfer, kCompute);
  }
  if (Result<void> recorded = record(*commands, *pipelines, plan, b); !recorded) return recorded.error();
  if (seen) {
    commands->barrier(kCompute, kHost);
  } else {
    commands->barrier(kCompute, kTransfer);
    commands->copy(BufferRange(b.parts, 0, parts), BufferRange(b.parts_back, 0, parts));
    constexpr uint64_t kSigns = batch::kSignWords * sizeof(uint32_t);
    for (size_t c = 0; c < plan.chunks.size(); ++c) {
      commands->copy(BufferRange(b.scratch, uint64_t{plan.chunks[c].signs} * sizeof(uint32_t), kSigns),
                     BufferRange(b.signs_back, c * kSigns, kSigns));
    }
    if (b.brought_vertices > 0 && b.brought_indices > 0) {
      commands->copy(BufferRange(b.vertices, 0, b.brought_vertices),
                     BufferRange(b.vertices_back, 0, b.brought_vertices));
      commands->copy(BufferRange(b.indices, 0, b.brought_indices), BufferRange(b.indices_back, 0, b.brought_indices));
    }
    commands->barrier(kTransfer, kHost);
  }
  return ring_.submit(std::move(*commands));
}

Result<Mesher::Output> Mesher::read(const BatchPlan& plan, BatchBuffers& b) {
  Output out;
  const bool seen = b.words.data() != nullptr;
  const Buffer& parts = seen ? b.parts : b.parts_back;
  if (Result<void> ready = parts.beforeRead(); !ready) return ready.error();
  out.head = reinterpret_cast<const batch::Head*>(parts.data());
  out.parts = reinterpret_cast<const batch::Part*>(parts.data() + kHeadSize);
  out.sums = reinterpret_cast<const batch::Sums*>(out.parts + plan.sizes.part_count);
  if (seen) {
    for (const Buffer* buffer : {&b.scratch, &b.vertices, &b.indices}) {
      if (Result<void> ready = buffer->beforeRead(); !ready) return ready.error();
    }
    out.signs = reinterpret_cast<const uint32_t*>(b.scratch.data());
    out.signs_in_place = true;
    out.vertices = reinterpret_cast<const Vertex*>(b.vertices.data());
    out.indices = reinterpret_cast<const uint32_t*>(b.indices.data());
    return out;
  }
  if (Result<void> ready = b.signs_back.beforeRead(); !ready) return ready.error();
  out.signs = reinterpret_cast<const uint32_t*>(b.signs_back.data());
  if (!plan.meshes || out.head->vertices == 0 || out.head->indices == 0) return out;
  if (Result<void> brought = downloadLater(*out.head, b); !brought) return brought.error();
  for (const Buffer* buffer : {&b.vertices_back, &b.indices_back}) {
    if (Result<void> ready = buffer->beforeRead(); !ready) return ready.error();
  }
  out.vertices = reinterpret_cast<const Vertex*>(b.vertices_back.data());
  out.indices = reinterpret_cast<const uint32_t*>(b.indices_back.data());
  return out;
}

/// Downloads the vertices and indices that the batch's own submission did not download.
Result<void> Mesher::downloadLater(const batch::Head& head, BatchBuffers& b) {
  const uint64_t vertices = uint64_t{head.vertices} * sizeof(Vertex);
  const uint64_t indices = uint64_t{head.indices} * sizeof(uint32_t);
  // Successive batches are similar. So the next batch, whose own numbers are unknown when it is submitted, downloads a
  // quarter more than this batch needed.
  usual_vertices_.store((vertices + vertices / 4) / 256 * 256);
  usual_indices_.store((indices + indices / 4) / 256 * 256);
  if (vertices <= b.brought_vertices && indices <= b.brought_indices) return {};
  if (Result<void> grown = grow(memory_, MemoryKind::readback, vertices, b.vertices_back); !grown) return grown.error();
  if (Result<void> grown = grow(memory_, MemoryKind::readback, indices, b.indices_back); !grown) return grown.error();
  Result<Commands> commands = ring_.begin();
  if (!commands) return commands.error();
  commands->copy(BufferRange(b.vertices, 0, vertices), BufferRange(b.vertices_back, 0, vertices));
  commands->copy(BufferRange(b.indices, 0, indices), BufferRange(b.indices_back, 0, indices));
  commands->barrier(kTransfer, kHost);
  const Result<uint64_t> value = ring_.submit(std::move(*commands));
  if (!value) return value.error();
  b.reading = *value;
  if (const Result<bool> ended = queue_.wait(*value); !ended) return ended.error();
  return {};
}

}  // namespace sgm::vulkan
