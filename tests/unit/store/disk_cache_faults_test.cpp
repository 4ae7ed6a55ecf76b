// Tests the disk cache with several processes, killed processes, and failures of its folder and of memory.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "disk_cache_support.h"

using namespace sgm;
using namespace std::chrono_literals;

namespace {

constexpr uint64_t kRoomy = uint64_t{1} << 30;

/// Reads and writes random entries until until() returns true; returns the number of entries with wrong contents.
template <class Until>
int useCache(DiskCache& cache, unsigned seed, uint64_t keys, Until until) {
  std::mt19937 random(seed);
  int wrong = 0;
  while (!until()) {
    const DiskKey key = keyNumber(random() % keys);
    const auto got = getFrom(cache, key);
    if (got && *got != contentOf(key)) ++wrong;
    if (!got) cache.put(key, contentOf(key));
  }
  const DiskCacheStats stats = cache.stats();
  return wrong + static_cast<int>(stats.errors + stats.damaged);
}

/// Runs work in a child process, whose exit status is the result of the work.
template <class Work>
pid_t forked(Work work) {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) _exit(work());
  return child;
}

int statusOf(pid_t child) {
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  return status;
}

std::vector<fs::path> unfinishedIn(const CacheFolder& folder) {
  std::vector<fs::path> parts = folder.files();
  std::erase_if(parts, [](const fs::path& file) { return file.extension() != ".part"; });
  return parts;
}

/// Records the notices of a disk cache.
struct Said {
  std::vector<std::string> lines;
  DiskCache::Log log() {
    return [this](const std::string& line) { lines.push_back(line); };
  }
};

}  // namespace

TEST_CASE("processes share a folder", "[stream][disk]") {
  const CacheFolder folder;
  constexpr uint64_t kLimit = 400'000;
  const auto end = std::chrono::steady_clock::now() + 1s;
  const auto late = [&](std::chrono::seconds by) { return std::chrono::steady_clock::now() >= end + by; };
  constexpr unsigned kProcesses = 3;
  std::vector<pid_t> children;
  for (unsigned i = 0; i < kProcesses; ++i) {
    children.push_back(forked([&] {
      auto cache = DiskCache::open(folder.path, kLimit, {});
      if (!cache) return 100;
      // Continues until more was stored than fits into the cache, on a slow machine as well.
      const auto enough = [&] { return (*cache)->stats().stored > 100; };
      const int wrong = useCache(**cache, i, 300, [&] { return late(0s) && (enough() || late(120s)); });
      return wrong != 0 || enough() ? wrong : 101;
    }));
  }
  for (const pid_t child : children) CHECK(statusOf(child) == 0);
  CHECK(folder.bytes() <= kLimit + (kProcesses - 1) * (kLimit / 8));
  CHECK(unfinishedIn(folder).empty());
  const auto cache = openCache(folder, kLimit);
  uint64_t kept = 0;
  for (uint64_t i = 0; i < 300; ++i) {
    const auto got = getFrom(*cache, keyNumber(i));
    if (got) REQUIRE((*got == contentOf(keyNumber(i))));
    kept += got.has_value();
  }
  CHECK(kept == folder.files().size());
  CHECK(kept > 30);
}

TEST_CASE("a killed process leaves nothing that is trusted and not whole, and no heap of files", "[stream][disk]") {
  const CacheFolder folder;
  constexpr uint64_t kLimit = 400'000;
  const unsigned kills = rounds(25);
  for (unsigned i = 0; i < kills; ++i) {
    int busy[2];
    REQUIRE(pipe(busy) == 0);
    const pid_t child = forked([&] {
      auto cache = DiskCache::open(folder.path, kLimit, {});
      int done = 0;
      return cache ? useCache(**cache, i, 300, [&] { return ++done == 20 && ::write(busy[1], "y", 1) != 1; }) : 100;
    });
    close(busy[1]);
    char said = 0;
    REQUIRE(read(busy[0], &said, 1) == 1);
    close(busy[0]);
    std::this_thread::sleep_for(std::chrono::microseconds(997 * i % 5000));
    REQUIRE(kill(child, SIGKILL) == 0);
    const int status = statusOf(child);
    REQUIRE(WIFSIGNALED(status));
    REQUIRE(unfinishedIn(folder).size() <= i + 1);
    REQUIRE(folder.bytes() <= kLimit);
    const auto cache = openCache(folder, kLimit);
    for (uint64_t k = 0; k < 300; ++k) {
      const auto got = getFrom(*cache, keyNumber(k));
      if (got) REQUIRE((*got == contentOf(keyNumber(k))));
    }
    REQUIRE(cache->stats().damaged == 0);
  }
  CHECK(folder.files().size() > 10);
  for (const fs::path& part : unfinishedIn(folder)) age(part, 1h);
  openCache(folder, kLimit)->put(keyNumber(1000), contentOf(keyNumber(1000)));
  CHECK(unfinishedIn(folder).empty());
}

TEST_CASE("a cache without a limit, without a folder or in a file is not opened", "[stream][disk]") {
  const CacheFolder folder;
  writeFile(folder.path / "file", {});
  const auto refused = [](const fs::path& place, uint64_t limit, Code code, const std::string& why) {
    const auto cache = DiskCache::open(place, limit, {});
    REQUIRE(!cache);
    CHECK(cache.error().code == code);
    CAPTURE(cache.error().message);
    CHECK(cache.error().message.find(why) != std::string::npos);
  };
  refused(folder.path, 0, Code::invalid_argument, "above 0 bytes");
  refused("", 1, Code::invalid_argument, "folder");
  refused(folder.path / "file", 1, Code::io, (folder.path / "file").string());
  refused(folder.path / "file" / "below", 1, Code::io, (folder.path / "file" / "below").string());
  openCache(folder, 1)->put(keyNumber(1), contentOf(keyNumber(1)));
  CHECK(folder.files().size() == 1);
  REQUIRE(DiskCache::open(folder.path / "new" / "newer", 1, {}));
}

TEST_CASE("a full disk is counted and said once", "[stream][disk]") {
  const CacheFolder folder;
  Said said;
  const auto cache = openCache(folder, kRoomy, said.log());
  const Bytes large = noise(1, 100'000);
  const DiskKey small = keyNumber(1);
  // A limit on the file size makes the write fail as a full disk does.
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit scarce = before;
  scarce.rlim_cur = 20'000;
  REQUIRE(setrlimit(RLIMIT_FSIZE, &scarce) == 0);
  cache->put(small, contentOf(small));
  for (uint64_t i = 2; i < 5; ++i) cache->put(keyNumber(i), large);
  REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, old_handler);
  CHECK(cache->stats().errors == 3);
  CHECK(cache->stats().stored == 1);
  REQUIRE(said.lines.size() == 1);
  CHECK(said.lines[0].find(folder.path.string()) != std::string::npos);
  CHECK(said.lines[0].find("File too large") != std::string::npos);
  CHECK(folder.files().size() == 1);
  CHECK((getFrom(*cache, small) == contentOf(small)));
  cache->put(keyNumber(2), large);
  CHECK((getFrom(*cache, keyNumber(2)) == large));
}

TEST_CASE("a folder may go and come while its cache is open", "[stream][disk]") {
  const CacheFolder folder;
  const CacheFolder inner{};
  Said said;
  const auto opened = DiskCache::open(inner.path / "cache", kRoomy, said.log());
  REQUIRE(opened);
  DiskCache& cache = **opened;
  const DiskKey key = keyNumber(1);
  cache.put(key, contentOf(key));
  fs::remove_all(inner.path / "cache");
  CHECK(!getFrom(cache, key));
  CHECK(cache.stats().errors == 0);
  for (int i = 0; i < 3; ++i) cache.put(key, contentOf(key));
  CHECK(cache.stats().errors == 3);
  writeFile(inner.path / "cache", {});  // replaces the cache's folder by a file
  CHECK(!getFrom(cache, key));
  cache.put(key, contentOf(key));
  CHECK(cache.stats().errors == 5);
  fs::remove(inner.path / "cache");
  fs::create_directory(inner.path / "cache");
  cache.put(key, contentOf(key));
  CHECK((getFrom(cache, key) == contentOf(key)));
  CHECK(said.lines.size() == 1);
}

TEST_CASE("a folder that may not be written to serves what it has", "[stream][disk]") {
  const CacheFolder folder;
  openCache(folder, kRoomy)->put(keyNumber(1), contentOf(keyNumber(1)));
  const fs::path shard = fileOf(folder, keyNumber(1)).parent_path();
  writeFile(fileOf(folder, keyNumber(2)), noise(1, 10));
  const auto guard = [&](fs::perms mode) {
    fs::permissions(fileOf(folder, keyNumber(2)).parent_path(), mode);
    fs::permissions(shard, mode);
    fs::permissions(folder.path, mode);
  };
  const pid_t child = forked([&] {
    // The superuser ignores file modes, so the test continues as another user.
    if (geteuid() == 0 && (chown(folder.path.c_str(), 65534, 65534) != 0 || chown(shard.c_str(), 65534, 65534) != 0 ||
                           chmod(folder.path.c_str(), 0755) != 0 || setgid(65534) != 0 || setuid(65534) != 0)) {
      return 1;
    }
    if (chmod(folder.path.c_str(), 0555) != 0 || chmod(shard.c_str(), 0555) != 0) return 2;
    Said said;
    const auto cache = DiskCache::open(folder.path, kRoomy, said.log());
    if (!cache) return 3;
    if (getFrom(**cache, keyNumber(1)) != contentOf(keyNumber(1))) return 4;
    if ((*cache)->stats().errors != 0) return 5;
    (*cache)->put(keyNumber(3), contentOf(keyNumber(3)));
    if ((*cache)->stats().errors != 1 || said.lines.size() != 1) return 6;
    if (said.lines[0].find("Permission denied") == std::string::npos) return 7;
    return 0;
  });
  const int status = statusOf(child);
  guard(fs::perms::owner_all);
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("a cache without memory is a cache without entries", "[stream][disk]") {
  const CacheFolder folder;
  const DiskKey key = keyNumber(1);
  openCache(folder, kRoomy)->put(key, contentOf(key));
  Said said;
  const auto cache = DiskCache::open(folder.path, kRoomy, said.log(), std::pmr::null_memory_resource());
  REQUIRE(cache);
  CHECK(!getFrom(**cache, key));
  (*cache)->put(keyNumber(2), contentOf(keyNumber(2)));
  CHECK((*cache)->stats().errors == 2);
  CHECK((*cache)->stats().misses == 1);
  CHECK((*cache)->stats().damaged == 0);
  REQUIRE(said.lines.size() == 1);
  CHECK(said.lines[0].find("memory") != std::string::npos);
  CHECK(!openCache(folder, kRoomy)->get(key, std::pmr::null_memory_resource()));
  CHECK(getFrom(*openCache(folder, kRoomy), key));
}
