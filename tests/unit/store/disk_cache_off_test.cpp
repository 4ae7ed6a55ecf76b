// Tests a build without zstd: it has no disk cache, and reports so.

#include "catch.h"
#include "store/cache/disk_cache.h"

TEST_CASE("a build without a disk cache says so", "[stream][disk]") {
  const auto cache = sgm::DiskCache::open("folder", 1, {});
  REQUIRE(!cache);
  CHECK(cache.error().code == sgm::Code::unsupported);
  CHECK(cache.error().message.find("SGM_DISK_CACHE") != std::string::npos);
}
