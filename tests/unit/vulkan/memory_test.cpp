#include "backend/vulkan/memory.h"

#include <map>
#include <optional>
#include <random>

#include "engine.h"
#include "support.h"

using namespace sgm;
using namespace sgm::vulkan;

namespace {

constexpr VkMemoryPropertyFlags kNear = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kSeen = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

VkPhysicalDeviceMemoryProperties memoryOf(std::vector<VkMemoryPropertyFlags> types) {
  VkPhysicalDeviceMemoryProperties memory{};
  memory.memoryTypeCount = static_cast<uint32_t>(types.size());
  for (size_t i = 0; i < types.size(); ++i) memory.memoryTypes[i] = {types[i], 0};
  memory.memoryHeapCount = 1;
  return memory;
}

/// The loader's real vkGetInstanceProcAddr. The functions below simulate a driver that allows 1 MiB of each heap, half
/// of which other programs use.
PFN_vkGetInstanceProcAddr real_resolver = nullptr;

VKAPI_ATTR void VKAPI_CALL scarceMemory(VkPhysicalDevice, VkPhysicalDeviceMemoryProperties2* properties) {
  auto* budget = static_cast<VkPhysicalDeviceMemoryBudgetPropertiesEXT*>(properties->pNext);
  REQUIRE(budget->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT);
  std::fill(std::begin(budget->heapBudget), std::end(budget->heapBudget), 1 << 20);
  std::fill(std::begin(budget->heapUsage), std::end(budget->heapUsage), 1 << 19);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL scarceResolver(VkInstance instance, const char* name) {
  if (std::string(name) != "vkGetPhysicalDeviceMemoryProperties2") return real_resolver(instance, name);
  return reinterpret_cast<PFN_vkVoidFunction>(scarceMemory);
}

}  // namespace

TEST_CASE("the driver's budget is kept where the driver tells it", "[vulkan]") {
  if (!haveDevice()) return;
  Engine engine;
  real_resolver = engine.instance->resolver();
  BorrowedDevice external = engine.lend();
  external.get_instance_proc_addr = scarceResolver;
  for (const bool told : {true, false}) {
    external.memory_budget = told;
    const auto device = Device::borrow(external);
    REQUIRE(device);
    Memory memory(**device);
    const auto large = memory.buffer(MemoryKind::device, 3 << 18);
    CHECK(bool(large) == !told);
    if (large) continue;
    CHECK(large.error().code == Code::out_of_memory);
    CHECK(large.error().message.find("1048576") != std::string::npos);
    // The budget does not allow a block of the usual size, so a smaller block is used.
    CHECK(memory.buffer(MemoryKind::device, 1 << 18));
    CHECK(memory.statistics().reserved <= 1 << 19);
  }
}

TEST_CASE("ranges never overlap, and all come back", "[vulkan]") {
  for (unsigned seed = 0; seed < rounds(40); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const uint64_t granule = uint64_t{1} << (random() % 9);
    const uint64_t size = granule * (1 + random() % 4000);
    Ranges ranges(size, granule);
    std::map<uint64_t, uint64_t> taken;
    for (int step = 0; step < 400; ++step) {
      if (taken.empty() || random() % 5 < 3) {
        const uint64_t bytes = 1 + random() % (size / (1 + random() % 64));
        const auto offset = ranges.take(bytes);
        // A simple reference allocator: scans all free ranges between used ones, and returns the first of the shortest
        // ranges that suffice.
        const uint64_t needed = (bytes + granule - 1) / granule * granule;
        std::optional<uint64_t> best;
        uint64_t shortest = UINT64_MAX, end = 0;
        const auto look = [&](uint64_t next) {
          if (next - end >= needed && next - end < shortest) best = end, shortest = next - end;
        };
        for (const auto& [at, length] : taken) {
          look(at);
          end = at + (length + granule - 1) / granule * granule;
        }
        look(size);
        REQUIRE(offset == best);
        if (!offset) continue;
        REQUIRE(*offset % granule == 0);
        REQUIRE(*offset + bytes <= size);
        const auto [it, fresh] = taken.emplace(*offset, bytes);
        REQUIRE(fresh);
        if (it != taken.begin()) REQUIRE(std::prev(it)->first + std::prev(it)->second <= *offset);
        if (std::next(it) != taken.end()) REQUIRE(*offset + bytes <= std::next(it)->first);
        REQUIRE(!ranges.empty());
      } else {
        const auto it = std::next(taken.begin(), static_cast<std::ptrdiff_t>(random() % taken.size()));
        ranges.give(it->first);
        taken.erase(it);
      }
    }
    for (const auto& [offset, bytes] : taken) ranges.give(offset);
    CHECK(ranges.empty());
    CHECK(ranges.take(size) == std::optional<uint64_t>(0));
  }
}

TEST_CASE("the tightest gap is taken", "[vulkan]") {
  Ranges ranges(64, 4);
  const auto wide = ranges.take(16), between = ranges.take(4), tight = ranges.take(8), last = ranges.take(4);
  REQUIRE((wide && between && tight && last));
  ranges.give(*wide);
  ranges.give(*tight);
  CHECK(ranges.take(6) == tight);
  CHECK(ranges.take(12) == wide);
}

TEST_CASE("each kind of memory is looked for where it is", "[vulkan]") {
  const auto choose = [](const std::vector<VkMemoryPropertyFlags>& types, MemoryKind kind, bool unified) {
    return chooseMemoryType(memoryOf(types), ~0u, kind, unified);
  };
  // The memory types of a graphics card that makes a part of its memory visible to the host, in the order in which
  // drivers list them.
  const std::vector<VkMemoryPropertyFlags> card{0, kNear, kSeen, kSeen | kCached, kNear | kSeen};
  CHECK(choose(card, MemoryKind::device, false) == 1);
  CHECK(choose(card, MemoryKind::upload, false) == 2);
  CHECK(choose(card, MemoryKind::readback, false) == 3);
  // The memory types of a device that shares all memory with the host.
  const std::vector<VkMemoryPropertyFlags> shared{kNear, kNear | kSeen, kNear | kSeen | kCached};
  CHECK(choose(shared, MemoryKind::device, true) == 1);
  CHECK(choose(shared, MemoryKind::upload, true) == 1);
  CHECK(choose(shared, MemoryKind::readback, true) == 2);
  // Devices with a single memory type, as software devices are.
  for (const MemoryKind kind : {MemoryKind::device, MemoryKind::upload, MemoryKind::readback}) {
    CHECK(choose({kNear | kSeen | kCached}, kind, true) == 0);
  }
  // For reading back, memory that is cached but not coherent is better than coherent and uncached memory.
  const VkMemoryPropertyFlags stale = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | kCached;
  CHECK(choose({kNear, kSeen, stale}, MemoryKind::readback, false) == 2);
  CHECK(choose({kNear, kSeen, stale}, MemoryKind::upload, false) == 1);
  // A device without cached memory, and a device without memory that is visible to the host.
  CHECK(choose({kNear, kSeen}, MemoryKind::readback, false) == 1);
  CHECK(choose({kNear}, MemoryKind::upload, false) == -1);
  // Memory types with other requirements, such as protected memory, are not chosen.
  CHECK(choose({kNear | VK_MEMORY_PROPERTY_PROTECTED_BIT}, MemoryKind::device, false) == -1);
  CHECK(chooseMemoryType(memoryOf(card), 1u << 4, MemoryKind::device, false) == 4);
  CHECK(chooseMemoryType(memoryOf(card), 0, MemoryKind::device, false) == -1);
}

TEST_CASE("buffers never overlap, and keep what was written", "[vulkan]") {
  TestDevice device;
  if (!device) return;
  MemoryOptions options;
  options.first_block = 1 << 16;
  options.largest_block = 1 << 18;
  Memory memory(*device, options);
  for (unsigned seed = 0; seed < rounds(5); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    struct Held {
      Buffer buffer;
      std::byte mark{};
    };
    std::vector<Held> held;
    uint64_t used = 0;
    const auto unspoilt = [](const Held& one) {
      return std::all_of(one.buffer.data(), one.buffer.data() + one.buffer.size(),
                         [&](std::byte byte) { return byte == one.mark; });
    };
    for (int step = 0; step < 300; ++step) {
      if (held.empty() || random() % 5 < 3) {
        const uint64_t most = random() % 20 == 0 ? 400'000 : 5000;
        auto made = memory.buffer(random() % 2 ? MemoryKind::upload : MemoryKind::readback, 1 + random() % most);
        REQUIRE(made);
        CHECK(made->offset() % 256 == 0);
        CHECK(made->offset() % device.device->limits().minStorageBufferOffsetAlignment == 0);
        const auto mark = static_cast<std::byte>(random() % 256);
        std::memset(made->data(), static_cast<int>(mark), made->size());
        used += made->size();
        held.push_back({std::move(*made), mark});
      } else {
        const size_t i = random() % held.size();
        REQUIRE(unspoilt(held[i]));
        used -= held[i].buffer.size();
        std::swap(held[i], held.back());
        held.pop_back();
      }
      REQUIRE(memory.statistics().used == used);
      REQUIRE(memory.statistics().buffers == held.size());
      REQUIRE(memory.statistics().reserved >= used);
    }
    for (const Held& one : held) REQUIRE(unspoilt(one));
  }
  CHECK(memory.statistics().used == 0);
  CHECK(memory.statistics().blocks <= 2);  // the allocator keeps one spare block of each kind
}

TEST_CASE("blocks double, and what is larger than any has its own", "[vulkan]") {
  TestDevice device;
  if (!device) return;
  MemoryOptions options;
  options.first_block = 1 << 16;
  options.largest_block = 1 << 17;
  Memory memory(*device, options);
  std::vector<Buffer> held;
  const auto take = [&](VkDeviceSize bytes) {
    auto made = memory.buffer(MemoryKind::device, bytes);
    REQUIRE(made);
    held.push_back(std::move(*made));
    return memory.statistics().reserved;
  };
  CHECK(take(40'000) == 1 << 16);
  CHECK(take(20'000) == 1 << 16);
  CHECK(take(40'000) == (1 << 16) + (1 << 17));
  CHECK(take(1 << 20) == (1 << 16) + (1 << 17) + (1 << 20));
  CHECK(memory.statistics().blocks == 3);
  held.pop_back();
  CHECK(memory.statistics().blocks == 2);
  held.clear();
  CHECK(memory.statistics().blocks == 1);
}

TEST_CASE("too much memory is refused, and what is there stays", "[vulkan]") {
  TestDevice device;
  if (!device) return;
  MemoryOptions options;
  options.first_block = 1 << 16;
  options.cap = 1 << 18;
  Memory memory(*device, options);
  CHECK(memory.buffer(MemoryKind::device, 0).error().code == Code::invalid_argument);
  auto kept = memory.buffer(MemoryKind::device, 1 << 16);
  REQUIRE(kept);
  const auto over = memory.buffer(MemoryKind::device, 1 << 18);
  REQUIRE(!over);
  CHECK(over.error().code == Code::limit);
  CHECK(over.error().message.find("262144") != std::string::npos);
  // The memory limit leaves no room for another block of the usual size, but enough for a block of just the requested
  // size.
  auto rest = memory.buffer(MemoryKind::device, 150'000);
  CHECK(rest);
  // Releases an unused block to make room for one of another kind.
  rest = Buffer();
  rest = memory.buffer(MemoryKind::device, 100'000);
  CHECK(rest);
  rest = Buffer();
  CHECK(memory.statistics().reserved == (1 << 16) + (1 << 17));
  CHECK(memory.buffer(MemoryKind::upload, 180'000));
  CHECK(memory.statistics().reserved == 1 << 16);

  Memory boundless(*device);
  for (const uint64_t bytes : {uint64_t{1} << 50, UINT64_MAX}) {
    const auto huge = boundless.buffer(MemoryKind::device, bytes);
    REQUIRE(!huge);
    CHECK(huge.error().code == Code::out_of_memory);
  }
  CHECK(boundless.statistics().blocks == 0);
}
