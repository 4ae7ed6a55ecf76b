#pragma once
// Folders, keys and contents for tests of the disk cache. The content of an entry is computed from its key.

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <random>

#include "base/hash.h"
#include "catch.h"
#include "rounds.h"
#include "store/cache/disk_cache.h"

namespace sgm {

namespace fs = std::filesystem;

using Bytes = std::pmr::vector<std::byte>;

struct CacheFolder {
  fs::path path;
  CacheFolder() {
    std::string name = (fs::temp_directory_path() / "sgm_cache_XXXXXX").string();
    path = mkdtemp(name.data());
  }
  CacheFolder(const CacheFolder&) = delete;
  ~CacheFolder() { fs::remove_all(path); }

  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(path)) {
      if (!entry.is_directory()) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  uint64_t bytes() const {
    uint64_t sum = 0;
    for (const fs::path& file : files()) sum += fs::file_size(file);
    return sum;
  }
};

inline DiskKey keyNumber(uint64_t number) { return {mix64(number + 1), mix64(~number)}; }

/// The path of an entry's file, as documented in disk_cache.h.
inline fs::path fileOf(const CacheFolder& folder, const DiskKey& key) {
  char name[40];
  std::snprintf(name, sizeof name, "%016llx%016llx", static_cast<unsigned long long>(key.high),
                static_cast<unsigned long long>(key.low));
  return folder.path / std::string(name, 2) / name;
}

/// Random bytes, which zstd cannot compress.
inline Bytes noise(uint64_t seed, size_t size) {
  Bytes bytes(size);
  for (size_t i = 0; i < size; i += 8) {
    const uint64_t word = hashCombine(seed, i);
    std::memcpy(bytes.data() + i, &word, std::min<size_t>(8, size - i));
  }
  return bytes;
}

/// The content of an entry: 0 to 8191 random bytes.
inline Bytes contentOf(const DiskKey& key) { return noise(key.low, key.high % 8192); }

inline Bytes readFile(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  Bytes bytes(text.size());
  if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

inline void writeFile(const fs::path& path, const Bytes& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  REQUIRE(out.flush());
}

/// Sets the time of a file's last use to `seconds` before now.
inline void age(const fs::path& file, std::chrono::seconds seconds) {
  fs::last_write_time(file, fs::file_time_type::clock::now() - seconds);
}

inline std::unique_ptr<DiskCache> openCache(const CacheFolder& folder, uint64_t byte_limit, DiskCache::Log log = {}) {
  Result<std::unique_ptr<DiskCache>> cache = DiskCache::open(folder.path, byte_limit, std::move(log));
  REQUIRE(cache);
  return std::move(*cache);
}

inline auto getFrom(DiskCache& cache, const DiskKey& key) { return cache.get(key, std::pmr::get_default_resource()); }

}  // namespace sgm
