#include "backend/vulkan/pipeline_cache.h"
#include "support.h"

// LeakSanitizer calls this function. The validation layer leaks some allocations of its own for each device.
extern "C" const char* __lsan_default_suppressions();
extern "C" __attribute__((visibility("default"))) const char* __lsan_default_suppressions() {
  return "leak:libVkLayer_khronos_validation";
}

namespace sgm::vulkan {

Result<std::vector<int32_t>> throughAllLayers(Device& device, std::span<const int32_t> numbers,
                                              const std::filesystem::path& cache_folder) {
  const auto count = static_cast<int32_t>(numbers.size());
  const uint32_t groups = static_cast<uint32_t>(numbers.size() + 63) / 64;
  auto cache = PipelineCache::create(device, cache_folder);
  if (!cache) return cache.error();
  const uint32_t three_five[] = {5, 3}, same[] = {0, 1};
  auto affine = Pipeline::create(device, affineShader(three_five), cache->get());
  if (!affine) return affine.error();
  auto identity = Pipeline::create(device, affineShader(same), cache->get());
  if (!identity) return identity.error();
  if (auto saved = (*cache)->save(); !saved) return saved.error();

  MemoryOptions small;
  small.first_block = small.largest_block = 1 << 20;
  Memory memory(device, small);
  auto up = memory.buffer(MemoryKind::upload, numbers.size_bytes());
  if (!up) return up.error();
  auto counts_up = memory.buffer(MemoryKind::upload, 3 * sizeof(int32_t));
  if (!counts_up) return counts_up.error();
  auto a = memory.buffer(MemoryKind::device, numbers.size_bytes());
  if (!a) return a.error();
  auto b = memory.buffer(MemoryKind::device, numbers.size_bytes());
  if (!b) return b.error();
  auto counts = memory.buffer(MemoryKind::device, 3 * sizeof(int32_t));
  if (!counts) return counts.error();
  auto down = memory.buffer(MemoryKind::readback, numbers.size_bytes());
  if (!down) return down.error();
  write(*up, numbers);
  write(*counts_up, std::array<int32_t, 3>{static_cast<int32_t>(groups), 1, 1});

  auto queue = Queue::create(device);
  if (!queue) return queue.error();
  auto ring = CommandRing::create(**queue, {2, 4, 2});
  if (!ring) return ring.error();
  auto commands = (*ring)->begin();
  if (!commands) return commands.error();
  commands->copy(*up, *a);
  commands->fill(*counts, 7);
  commands->fill(*b, 7);
  commands->barrier(kTransfer, kCompute);
  const int32_t three = 3;
  if (auto bound = commands->bind(*identity, std::array<BufferRange, 2>{*counts_up, *counts}, bytesOf(three)); !bound) {
    return bound.error();
  }
  commands->dispatch(1);
  if (auto bound = commands->bind(*affine, std::array<BufferRange, 2>{*a, *b}, bytesOf(count)); !bound) {
    return bound.error();
  }
  commands->dispatch(groups);
  commands->barrier(kCompute, kCompute | kIndirect);
  if (auto bound = commands->bind(*affine, std::array<BufferRange, 2>{*b, *a}, bytesOf(count)); !bound) {
    return bound.error();
  }
  commands->dispatchIndirect(*counts);
  commands->barrier(kCompute, kTransfer);
  commands->copy(*a, *down);
  commands->barrier(kTransfer, kHost);
  const auto value = (*ring)->submit(std::move(*commands));
  if (!value) return value.error();
  const auto ended = (*queue)->wait(*value);
  if (!ended) return ended.error();
  if (auto ready = down->beforeRead(); !ready) return ready.error();
  return numbersOf(*down);
}

}  // namespace sgm::vulkan
