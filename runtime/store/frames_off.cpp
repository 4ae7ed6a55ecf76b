#include "store/frames.h"

namespace sgm::store {

Result<void> available() {
  return Error{Code::unsupported, "this build has no stores of baked worlds: configure it with SGM_DISK_CACHE=ON"};
}

ContentId idOf(std::span<const std::byte>) { return {}; }
IdStream::IdStream() : state_(nullptr) {}
IdStream::~IdStream() = default;
void IdStream::add(std::span<const std::byte>) {}
ContentId IdStream::id() const { return {}; }
uint64_t checksumOf(std::span<const std::byte>) { return 0; }
Result<std::pmr::vector<std::byte>> pack(std::span<const std::byte>, std::pmr::memory_resource*) {
  return available().error();
}
std::optional<std::pmr::vector<std::byte>> unpack(std::span<const std::byte>, size_t, std::pmr::memory_resource*) {
  return std::nullopt;
}
Unpacker::~Unpacker() = default;
std::optional<std::pmr::vector<std::byte>> Unpacker::unpack(std::span<const std::byte>, size_t,
                                                            std::pmr::memory_resource*) {
  return std::nullopt;
}

}  // namespace sgm::store
