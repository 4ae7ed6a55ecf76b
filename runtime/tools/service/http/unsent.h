#pragma once
// Limits the memory of answers that clients have not yet received.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>

namespace sgm::service::http {

/// For one server. Used only in its thread.
class Unsent {
 public:
  explicit Unsent(uint64_t max_bytes) : most_(max_bytes) {}

  /// Counts the size of a body until release() has been called as often as hold(); a body that is already held costs
  /// nothing. Returns false, without holding the body, if the total would exceed the limit and other bodies are held.
  /// Null and bodies below 4 KiB are always accepted. If it throws std::bad_alloc, the body is not held.
  bool hold(const std::shared_ptr<const std::string>& body);
  void release(const std::shared_ptr<const std::string>& body) noexcept;

 private:
  uint64_t most_;
  uint64_t bytes_ = 0;
  std::unordered_map<const std::string*, size_t> holds_;
};

}  // namespace sgm::service::http
