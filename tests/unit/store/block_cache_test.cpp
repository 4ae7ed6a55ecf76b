// Tests that cached blocks have the bytes of their files, and are read once.

#include <atomic>
#include <catch2/catch.hpp>
#include <random>
#include <thread>

#include "store/block_cache.h"

using namespace sgm;
using store::BlockCache;

namespace {

std::byte byteOf(uint64_t file, uint64_t at) {
  return static_cast<std::byte>((file * 977 + at * 31 + (at >> 8)) & 255);
}

struct File {
  uint64_t number, size;
  std::atomic<uint64_t>* fetched;
  std::atomic<int>* wrong;
  BlockCache::Fetch fetch() const {
    return [this](uint64_t offset, size_t bytes) -> Result<std::pmr::vector<std::byte>> {
      *wrong += offset % BlockCache::kBlock != 0 || bytes > BlockCache::kMaxConcurrent * BlockCache::kBlock ||
                ((offset + bytes) % BlockCache::kBlock != 0 && offset + bytes != size);
      *fetched += bytes;
      std::pmr::vector<std::byte> all(bytes);
      for (size_t i = 0; i < bytes; ++i) all[i] = byteOf(number, offset + i);
      return all;
    };
  }
};

/// Reads a random part of the file, and checks its bytes.
bool readsRight(BlockCache& cache, const File& file, std::mt19937& random) {
  const uint64_t offset = random() % file.size;
  const size_t bytes = random() % std::min<uint64_t>(file.size - offset, random() % 8 ? 9000 : 900000);
  const auto got = cache.read(file.number, file.size, offset, bytes, file.fetch(), std::pmr::get_default_resource());
  if (!got || got->size() != bytes) return false;
  for (size_t i = 0; i < bytes; ++i) {
    if ((*got)[i] != byteOf(file.number, offset + i)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("blocks give what their files have, each fetched once while there is room", "[store][threads]") {
  const auto seed = GENERATE(take(2, random(0, 1 << 30)));
  CAPTURE(seed);
  std::atomic<uint64_t> fetched = 0;
  std::atomic<int> wrong = 0;
  const std::vector<File> files{{0, 3 * BlockCache::kBlock + 17, &fetched, &wrong},
                                {1, BlockCache::kBlock, &fetched, &wrong},
                                {2, 9 * BlockCache::kBlock - 1, &fetched, &wrong}};
  BlockCache cache(std::pmr::get_default_resource());
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      std::mt19937 random(static_cast<uint32_t>(seed) + t);
      for (int i = 0; i < 60; ++i) wrong += !readsRight(cache, files[random() % 3], random);
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
  CHECK(fetched <= files[0].size + files[1].size + files[2].size);
}

TEST_CASE("a file larger than all blocks that are kept is read all the same", "[store]") {
  std::atomic<uint64_t> fetched = 0;
  std::atomic<int> wrong = 0;
  const File file{3, (BlockCache::kMaxBlocks + 9) * BlockCache::kBlock + 5, &fetched, &wrong};
  BlockCache cache(std::pmr::get_default_resource());
  for (int again = 0; again < 2; ++again) {
    const auto all = cache.read(file.number, file.size, 0, static_cast<size_t>(file.size), file.fetch(),
                                std::pmr::get_default_resource());
    REQUIRE(all);
    REQUIRE(all->size() == file.size);
    CHECK(all->back() == byteOf(3, file.size - 1));
    CHECK((*all)[BlockCache::kBlock] == byteOf(3, BlockCache::kBlock));
  }
  CHECK(wrong == 0);
}

TEST_CASE("what could not be fetched is fetched again", "[store]") {
  BlockCache cache(std::pmr::get_default_resource());
  std::atomic<uint64_t> fetched = 0;
  std::atomic<int> wrong = 0;
  const File file{4, 2 * BlockCache::kBlock, &fetched, &wrong};
  const BlockCache::Fetch failing = [](uint64_t, size_t) -> Result<std::pmr::vector<std::byte>> {
    return Error{Code::busy, "away"};
  };
  const BlockCache::Fetch throwing = [](uint64_t, size_t) -> Result<std::pmr::vector<std::byte>> {
    throw std::bad_alloc();
  };
  const auto read = [&](const BlockCache::Fetch& fetch) {
    return cache.read(4, file.size, 100, static_cast<size_t>(file.size) - 200, fetch, std::pmr::get_default_resource());
  };
  const auto failed = read(failing);
  REQUIRE(!failed);
  CHECK(failed.error().code == Code::busy);
  const auto cut = read([](uint64_t, size_t bytes) -> Result<std::pmr::vector<std::byte>> {
    return std::pmr::vector<std::byte>(bytes / 2);
  });
  REQUIRE(!cut);
  CHECK(cut.error().code == Code::io);
  CHECK_THROWS_AS(read(throwing), std::bad_alloc);
  const auto got = read(file.fetch());
  REQUIRE(got);
  CHECK(got->front() == byteOf(4, 100));
  CHECK(fetched == file.size);
  CHECK(read(failing));
}
