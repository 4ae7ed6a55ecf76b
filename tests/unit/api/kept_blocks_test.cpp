// Tests the cache of memory blocks: blocks keep their contents, never overlap, are reused, and the cache is bounded.

#include "api/kept_blocks.h"

#include <atomic>
#include <cstring>
#include <map>
#include <random>
#include <thread>

#include "catch.h"
#include "rounds.h"
#include "seed.h"

using namespace sgm;
using sgm::api::KeptBlocks;

namespace {

struct Held {
  unsigned char* memory;
  size_t size, alignment;
  unsigned char mark;
};

/// Allocates and frees blocks of all sizes. Each block is marked at its ends and in its middle. Returns the number of
/// marks that were overwritten.
size_t useBlocks(KeptBlocks& blocks, uint32_t seed, unsigned steps) {
  std::mt19937 random(seed);
  std::vector<Held> held;
  size_t wrong = 0;
  const auto give = [&](size_t i) {
    const Held h = held[i];
    for (const size_t at : {size_t{0}, h.size / 2, h.size - 1}) wrong += h.memory[at] != h.mark;
    blocks.release(h.memory, h.size, h.alignment);
    held[i] = held.back();
    held.pop_back();
  };
  for (unsigned step = 0; step < steps; ++step) {
    if (held.size() > 12 || (!held.empty() && random() % 2 == 0)) {
      give(random() % held.size());
      continue;
    }
    const size_t size = 1 + (random() >> (random() % 25 + 7));
    const size_t alignment = size_t{1} << random() % 13;
    auto* memory = static_cast<unsigned char*>(blocks.allocate(size, alignment));
    if (memory == nullptr) continue;
    wrong += reinterpret_cast<uintptr_t>(memory) % alignment != 0;
    const auto mark = static_cast<unsigned char>(random());
    memory[0] = memory[size / 2] = memory[size - 1] = mark;
    held.push_back({memory, size, alignment, mark});
  }
  while (!held.empty()) give(0);
  return wrong;
}

}  // namespace

TEST_CASE("a block that came back is given out again for nearly the same size") {
  KeptBlocks blocks;
  void* first = blocks.allocate(1'000'000, 16);
  std::memset(first, 1, 1'000'000);
  blocks.release(first, 1'000'000, 16);
  void* second = blocks.allocate(990'000, 8);
  CHECK(second == first);
  void* third = blocks.allocate(990'000, 8);
  CHECK(third != second);
  blocks.release(second, 990'000, 8);
  blocks.release(third, 990'000, 8);
  // Sizes are rounded up to eighths of a power of two, so 1,060,000 bytes need a larger size class than 990,000 bytes.
  void* larger = blocks.allocate(1'060'000, 16);
  CHECK(larger != first);
  CHECK(larger != third);
  blocks.release(larger, 1'060'000, 16);
}

TEST_CASE("kept blocks hold what is written, at what they are aligned to, over random sizes") {
  const uint32_t seed = testSeed();
  CAPTURE(seed);
  KeptBlocks blocks;
  CHECK(useBlocks(blocks, seed, rounds(4000)) == 0);
}

TEST_CASE("threads may take and give blocks at one time", "[threads]") {
  const uint32_t seed = testSeed();
  CAPTURE(seed);
  KeptBlocks blocks;
  std::atomic<size_t> wrong{0};
  std::vector<std::thread> threads;
  for (uint32_t i = 0; i < 4; ++i) threads.emplace_back([&, i] { wrong += useBlocks(blocks, seed + i, rounds(1000)); });
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
}

TEST_CASE("what is kept stays below its bound") {
  KeptBlocks blocks;
  // Allocates twice as many bytes as may be cached, in blocks of two sizes. Each block is written to, so that memory
  // that is not released shows as resident.
  std::vector<void*> held;
  constexpr size_t kSize = size_t{1} << 22;
  for (size_t bytes = 0; bytes < 2 * KeptBlocks::kMost; bytes += kSize) held.push_back(blocks.allocate(kSize, 64));
  for (void* memory : held) blocks.release(memory, kSize, 64);
  CHECK(blocks.bytes() <= KeptBlocks::kMost);
  CHECK(blocks.bytes() > KeptBlocks::kMost / 2);
  void* other = blocks.allocate(kSize / 2, 64);
  blocks.release(other, kSize / 2, 64);
  CHECK(blocks.bytes() <= KeptBlocks::kMost);
}

TEST_CASE("where the system has no memory left, all that is kept goes before anybody is refused") {
  struct Scarce {
    size_t left = size_t{40} << 20;
    std::map<void*, size_t> given;
  } scarce;
  const sgm_allocator system{[](void* user, size_t size, size_t alignment) -> void* {
                               auto& s = *static_cast<Scarce*>(user);
                               if (size > s.left) return nullptr;
                               void* memory = sgm::api::systemAllocator().allocate(nullptr, size, alignment);
                               s.left -= size;
                               s.given[memory] = size;
                               return memory;
                             },
                             [](void* user, void* memory, size_t size, size_t alignment) {
                               auto& s = *static_cast<Scarce*>(user);
                               CHECK(s.given.at(memory) == size);
                               s.given.erase(memory);
                               s.left += size;
                               sgm::api::systemAllocator().release(nullptr, memory, size, alignment);
                             },
                             &scarce};
  {
    KeptBlocks blocks(system);
    constexpr size_t kHalf = size_t{16} << 20, kMore = size_t{24} << 20, kUnkept = size_t{5000} << 13;
    void* half = blocks.allocate(kHalf, 64);
    REQUIRE(half != nullptr);
    void* other = blocks.allocate(kHalf, 64);
    CHECK(blocks.allocate(kMore, 64) == nullptr);  // both blocks are in use, so neither can be released
    blocks.release(half, kHalf, 64);
    CHECK(blocks.bytes() == kHalf);
    void* more = blocks.allocate(kMore, 64);
    CHECK(more != nullptr);
    CHECK(blocks.bytes() == 0);
    blocks.release(other, kHalf, 64);
    blocks.release(more, kMore, 64);
    // To make room, all cached blocks must be released, even though blocks of the size requested here are never cached.
    CHECK(blocks.allocate(kUnkept * 2, 64) == nullptr);
    void* whole = blocks.allocate(10000, 64);
    CHECK(whole != nullptr);
    blocks.release(whole, 10000, 64);
  }
  CHECK(scarce.given.empty());
}
