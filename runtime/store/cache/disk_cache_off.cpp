#include "store/cache/disk_cache.h"

namespace sgm {

Result<std::unique_ptr<DiskCache>> DiskCache::open(const std::filesystem::path&, uint64_t, Log,
                                                   std::pmr::memory_resource*) {
  return Error{Code::unsupported, "this build has no disk cache: configure it with SGM_DISK_CACHE=ON"};
}

}  // namespace sgm
