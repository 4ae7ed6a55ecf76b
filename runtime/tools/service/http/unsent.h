#pragma once
// Counts the memory of answers that clients have not received yet.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>

namespace sgm::service::http {

/// For one server, in its thread.
class Unsent {
 public:
  explicit Unsent(uint64_t most_bytes) : most_(most_bytes) {}

  /// Counts a body until it is released as often as it was held; a body that is already held costs nothing. False if
  /// there is no room besides others; then it is not held. Null and bodies below 4 KiB always have room. Throws
  /// std::bad_alloc, without holding the body.
  bool hold(const std::shared_ptr<const std::string>& body);
  void release(const std::shared_ptr<const std::string>& body) noexcept;

 private:
  uint64_t most_;
  uint64_t bytes_ = 0;
  std::unordered_map<const std::string*, size_t> holds_;
};

}  // namespace sgm::service::http
