#include "store/http_files.h"

namespace sgm::store {

Result<std::unique_ptr<StoreFiles>> httpFiles(const std::string&, const Log&, std::pmr::memory_resource*) {
  return Error{Code::unsupported, "this build reads stores only from folders: build it with SGM_HTTP_STORES=ON"};
}

}  // namespace sgm::store
