// Tests the disk cache: it returns what was stored or nothing, keeps to its size limit, and tolerates any files in its
// folder.

#include "store/cache/disk_cache.h"

#include <sys/stat.h>

#include <chrono>
#include <map>
#include <thread>

#include "disk_cache_support.h"
#include "store/cache/disk_entry.h"

using namespace sgm;
using namespace std::chrono_literals;

namespace {

constexpr uint64_t kPlenty = uint64_t{1} << 30;

/// Writes a file in place of a key's entry. Expects a counted miss, and that the cache removes the file.
void expectDamaged(DiskCache& cache, const CacheFolder& folder, const DiskKey& key, const Bytes& file) {
  writeFile(fileOf(folder, key), file);
  const DiskCacheStats before = cache.stats();
  REQUIRE(!getFrom(cache, key));
  REQUIRE(cache.stats().damaged == before.damaged + 1);
  REQUIRE(cache.stats().misses == before.misses + 1);
  REQUIRE(!fs::exists(fileOf(folder, key)));
}

}  // namespace

TEST_CASE("what is put is got, by whoever opens the folder", "[stream][disk]") {
  const auto seed = GENERATE(take(4, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const CacheFolder folder;
  const auto cache = openCache(folder, kPlenty), other = openCache(folder, kPlenty);
  std::map<DiskKey, Bytes> model;
  for (unsigned i = 0; i < rounds(100); ++i) {
    const DiskKey key = keyNumber(random() % 60);
    const auto got = getFrom(random() % 2 ? *cache : *other, key);
    const auto known = model.find(key);
    REQUIRE(got.has_value() == (known != model.end()));
    if (got) REQUIRE((*got == known->second));
    if (known != model.end()) continue;
    Bytes content = noise(random(), random() % 3 ? random() % 3000 : random() % 300'000);
    if (random() % 2) std::fill(content.begin(), content.end(), static_cast<std::byte>(random()));
    if (random() % 8 == 0) content.clear();
    (random() % 2 ? *cache : *other).put(key, content);
    model[key] = std::move(content);
  }
  const DiskCacheStats a = cache->stats(), b = other->stats();
  CHECK(a.stored + b.stored == model.size());
  CHECK(a.hits + b.hits + model.size() == rounds(100));
  CHECK(a.errors + b.errors + a.damaged + b.damaged + a.evicted + b.evicted + a.dropped + b.dropped == 0);
  CHECK(folder.files().size() == model.size());
  const auto third = openCache(folder, kPlenty);
  for (const auto& [key, content] : model) REQUIRE((getFrom(*third, key) == content));
}

TEST_CASE("an entry that was put twice is stored once", "[stream][disk]") {
  const CacheFolder folder;
  const auto cache = openCache(folder, kPlenty);
  const DiskKey key = cache->keyOf(contentOf(keyNumber(1)));
  CHECK(key != cache->keyOf(contentOf(keyNumber(2))));
  CHECK(key == cache->keyOf(contentOf(keyNumber(1))));
  for (int i = 0; i < 3; ++i) cache->put(key, contentOf(key));
  CHECK(cache->stats().stored == 1);
  CHECK(cache->stats().errors == 0);
  CHECK(cache->stats().bytes == folder.bytes());
}

TEST_CASE("a file of any length or with any changed bit is a miss", "[stream][disk]") {
  const CacheFolder folder;
  const auto cache = openCache(folder, kPlenty);
  const DiskKey key = keyNumber(5);
  const Bytes content = noise(1, 60);
  cache->put(key, content);
  const Bytes file = readFile(fileOf(folder, key));
  REQUIRE(file.size() > content.size());
  for (size_t length = 0; length < file.size(); ++length) {
    CAPTURE(length);
    expectDamaged(*cache, folder, key, {file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length)});
  }
  Bytes longer = file;
  longer.push_back(std::byte{0});
  expectDamaged(*cache, folder, key, longer);
  for (size_t bit = 0; bit < 8 * file.size(); ++bit) {
    CAPTURE(bit);
    Bytes changed = file;
    changed[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    expectDamaged(*cache, folder, key, changed);
  }
  writeFile(fileOf(folder, key), file);
  CHECK((getFrom(*cache, key) == content));
  CHECK(cache->stats().errors == 0);
}

TEST_CASE("a false size, another's entry or no entry at all is a miss", "[stream][disk]") {
  const CacheFolder folder;
  const auto cache = openCache(folder, kPlenty);
  const DiskKey key = keyNumber(1), other = keyNumber(2);
  // An entry that is small on the disk but large when unpacked.
  Bytes zeros(1 << 20);
  const auto file = packDiskEntry(key, zeros, std::pmr::get_default_resource());
  REQUIRE(file);
  REQUIRE(file->size() < 1000);
  REQUIRE((unpackDiskEntry(key, *file, std::pmr::get_default_resource()) == zeros));
  constexpr size_t kContentBytesAt = 24;
  for (const uint64_t claim : {uint64_t{0}, uint64_t{1}, uint64_t{1 << 20} - 1, uint64_t{1 << 20} + 1,
                               uint64_t{kMaxDiskContent}, uint64_t{kMaxDiskContent} + 1, ~uint64_t{0}}) {
    CAPTURE(claim);
    Bytes changed = *file;
    std::memcpy(changed.data() + kContentBytesAt, &claim, sizeof claim);
    expectDamaged(*cache, folder, key, changed);
  }
  expectDamaged(*cache, folder, other, *file);
  expectDamaged(*cache, folder, key, noise(3, 5000));

  fs::create_directories(fileOf(folder, key).parent_path());
  writeFile(folder.path / "elsewhere", *file);
  fs::create_symlink(folder.path / "elsewhere", fileOf(folder, key));
  CHECK(!getFrom(*cache, key));
  CHECK(fs::exists(folder.path / "elsewhere"));
  CHECK(!fs::exists(fs::symlink_status(fileOf(folder, key))));
  REQUIRE(mkfifo(fileOf(folder, key).c_str(), 0600) == 0);
  CHECK(!getFrom(*cache, key));
  CHECK(!fs::exists(fileOf(folder, key)));
  std::ofstream(fileOf(folder, key)) << "";
  fs::resize_file(fileOf(folder, key), kMaxDiskEntry + 1);
  CHECK(!getFrom(*cache, key));
  CHECK(!fs::exists(fileOf(folder, key)));
  CHECK(cache->stats().errors == 0);
  // The cache never removes a folder at an entry's path, so this entry can never be stored.
  fs::create_directory(fileOf(folder, key));
  CHECK(!getFrom(*cache, key));
  cache->put(key, zeros);
  CHECK(!getFrom(*cache, key));
  CHECK(fs::is_directory(fileOf(folder, key)));
  CHECK(cache->stats().damaged == 7 + 2 + 3 + 2);
}

TEST_CASE("the longest unused go first", "[stream][disk]") {
  const auto seed = GENERATE(take(3, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const CacheFolder folder;
  constexpr uint64_t kEntries = 20;
  const Bytes content = noise(9, 10'000);
  std::vector<uint64_t> by_age(kEntries);
  for (uint64_t i = 0; i < kEntries; ++i) by_age[i] = i;
  std::shuffle(by_age.begin(), by_age.end(), random);
  uint64_t entry_bytes = 0;
  {
    const auto cache = openCache(folder, kPlenty);
    for (uint64_t i = 0; i < kEntries; ++i) {
      cache->put(keyNumber(by_age[i]), content);
      age(fileOf(folder, keyNumber(by_age[i])), std::chrono::seconds(1000 - i));
    }
    entry_bytes = folder.bytes() / kEntries;
    // The two oldest entries are read again, so that they count as recently used.
    for (uint64_t i = 0; i < 2; ++i) REQUIRE(getFrom(*cache, keyNumber(by_age[i])));
  }
  const auto cache = openCache(folder, kEntries * entry_bytes + entry_bytes / 2);
  cache->put(keyNumber(1000), content);
  // The cache frees an eighth of its limit, and then stores the new entry.
  const uint64_t evicted = cache->stats().evicted;
  CHECK(evicted == 3);
  for (uint64_t i = 0; i < kEntries; ++i) {
    CAPTURE(i);
    CHECK(fs::exists(fileOf(folder, keyNumber(by_age[i]))) == (i < 2 || i >= 2 + evicted));
  }
  CHECK(getFrom(*cache, keyNumber(1000)));
  CHECK(cache->stats().bytes == folder.bytes());
}

TEST_CASE("the limit holds after every put", "[stream][disk]") {
  const auto seed = GENERATE(take(3, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const CacheFolder folder;
  const uint64_t limit = 200'000 + random() % 100'000;
  const auto cache = openCache(folder, limit);
  uint64_t largest = 0;
  for (unsigned i = 0; i < rounds(150); ++i) {
    const size_t size = random() % 20 == 0 ? random() % (2 * limit) : random() % 20'000;
    const DiskKey key = keyNumber(random());
    const DiskCacheStats before = cache->stats();
    cache->put(key, noise(i, size));
    const uint64_t bytes = folder.bytes();
    largest = std::max(largest, bytes);
    CAPTURE(i, size, limit);
    REQUIRE(bytes <= limit);
    REQUIRE(cache->stats().bytes == bytes);
    const bool stored = cache->stats().stored > before.stored;
    REQUIRE((cache->stats().dropped > before.dropped) == !stored);
    REQUIRE(stored == (size + 100 < limit));
    REQUIRE(getFrom(*cache, key).has_value() == stored);
  }
  CHECK(cache->stats().evicted > 0);
  CHECK(largest > limit / 2);
}

TEST_CASE("a folder that is far over the limit is brought below it, set by set", "[stream][disk]") {
  const CacheFolder folder;
  constexpr uint64_t kLimit = uint64_t{64} << 20;
  uint64_t before = 0;
  for (uint64_t i = 0; i < 400; ++i) {
    const fs::path file = fileOf(folder, keyNumber(i));
    writeFile(file, {});
    fs::resize_file(file, 1 << 18);  // a sparse file, which takes no space on the disk
    age(file, std::chrono::seconds(1 + i));
    before += 1 << 18;
  }
  const fs::path foreign[] = {folder.path / "README", fileOf(folder, keyNumber(0)).parent_path() / "notes",
                              folder.path / "00" / "ff000000000000000000000000000000",
                              folder.path / "00" / "00000000000000000000000000ABCDEF"};
  for (const fs::path& file : foreign) writeFile(file, {});
  REQUIRE(folder.bytes() == before);
  const auto cache = openCache(folder, kLimit);
  CHECK(cache->stats().bytes == 0);
  for (uint64_t i = 0; i < 64; ++i) cache->put({i << 58, i}, contentOf({i, i}));
  CHECK(folder.bytes() <= kLimit);
  CHECK(folder.bytes() > kLimit / 2);
  CHECK(cache->stats().bytes == folder.bytes());
  CHECK(cache->stats().stored == 64);
  for (uint64_t i = 0; i < 64; ++i) CHECK(getFrom(*cache, {i << 58, i}));
  for (const fs::path& file : foreign) CHECK(fs::exists(file));
  // In each of its sets, the cache has kept the latest entries, so these 60 still exist.
  size_t late = 0;
  for (uint64_t i = 0; i < 60; ++i) late += fs::exists(fileOf(folder, keyNumber(i)));
  CHECK(late == 60);
}

TEST_CASE("what a killed process was writing is in nobody's way for long", "[stream][disk]") {
  const CacheFolder folder;
  const auto cache = openCache(folder, kPlenty);
  const DiskKey key = keyNumber(1), other{keyNumber(1).high, 7};
  const fs::path part = fileOf(folder, key).string() + ".part", left = fileOf(folder, other).string() + ".part";
  const Bytes content = contentOf(key);
  // Another process may still be writing this file, with the same contents, so the file is left alone.
  writeFile(part, noise(1, 100));
  cache->put(key, content);
  CHECK(!getFrom(*cache, key));
  CHECK(fs::exists(part));
  age(part, 1h);
  cache->put(key, content);
  CHECK((getFrom(*cache, key) == content));
  CHECK(!fs::exists(part));
  // An unfinished file of an entry that is never requested again is removed when its set is listed.
  writeFile(left, noise(1, 100));
  age(left, 1h);
  openCache(folder, 1 << 20)->put(keyNumber(2), content);
  CHECK(!fs::exists(left));
  CHECK(cache->stats().errors == 0);
}

TEST_CASE("threads share a cache", "[stream][disk][threads]") {
  const CacheFolder folder;
  constexpr uint64_t kLimit = 400'000;
  const auto cache = openCache(folder, kLimit);
  std::atomic<uint64_t> gets = 0, puts = 0, wrong = 0;
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 6; ++t) {
    threads.emplace_back([&, t] {
      std::mt19937 random(t);
      for (unsigned i = 0; i < rounds(500); ++i) {
        const DiskKey key = keyNumber(random() % 200);  // the processes store twice as much in total as the limit
                                                        // allows
        const auto got = getFrom(*cache, key);
        ++gets;
        if (got && *got != contentOf(key)) ++wrong;
        if (got) continue;
        cache->put(key, contentOf(key));
        ++puts;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  const DiskCacheStats stats = cache->stats();
  CHECK(wrong == 0);
  CHECK(stats.hits + stats.misses == gets);
  CHECK(stats.stored <= puts);
  CHECK(stats.stored > 100);
  CHECK(stats.hits > 100);
  CHECK(stats.evicted > 100);
  CHECK(stats.errors + stats.damaged == 0);
  CHECK(folder.bytes() <= kLimit);
  CHECK(folder.files().size() == stats.stored - stats.evicted);
}
