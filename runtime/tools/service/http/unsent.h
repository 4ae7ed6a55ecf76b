#pragma once
// What answers hold of memory until their clients have taken them.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>

namespace sgm::service::http {

/// Of one server, on its thread.
class Unsent {
 public:
  explicit Unsent(uint64_t most_bytes) : most_(most_bytes) {}

  /// Counts a body until it is released as often as it was held; one that is held already takes no more. False: there
  /// is no room for it beside others, and it is not held. Null and bodies below 4 KiB always have room. Throws
  /// std::bad_alloc, and holds nothing then.
  bool hold(const std::shared_ptr<const std::string>& body);
  void release(const std::shared_ptr<const std::string>& body) noexcept;

 private:
  uint64_t most_;
  uint64_t bytes_ = 0;
  std::unordered_map<const std::string*, size_t> holds_;
};

}  // namespace sgm::service::http
