#pragma once
// Limits the memory of answers that clients have not yet received.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>

namespace sgm::service::http {

/// Counter of the unsent bodies of one server. Used on the server's thread only.
class Unsent {
 public:
  explicit Unsent(uint64_t max_bytes) : most_(max_bytes) {}

  /// Counts a body's size until release() has been called as often as hold(). Holding the same body again costs
  /// nothing. Returns false, without holding the body, if the total would exceed the limit and another body is held.
  /// Null and bodies below 4 KiB are always accepted. If hold() throws std::bad_alloc, the body is not held.
  bool hold(const std::shared_ptr<const std::string>& body);
  void release(const std::shared_ptr<const std::string>& body) noexcept;

 private:
  uint64_t most_;
  uint64_t bytes_ = 0;
  std::unordered_map<const std::string*, size_t> holds_;
};

}  // namespace sgm::service::http
