#include "tools/service/http/unsent.h"

namespace sgm::service::http {

namespace {

/// Smaller bodies are not counted, so that error answers, which need little memory, can always be sent.
constexpr size_t kSmallBody = 4096;

bool isCounted(const std::shared_ptr<const std::string>& body) { return body && body->size() >= kSmallBody; }

}  // namespace

bool Unsent::hold(const std::shared_ptr<const std::string>& body) {
  if (!isCounted(body)) return true;
  if (const auto held = holds_.find(body.get()); held != holds_.end()) {
    ++held->second;
    return true;
  }
  if (bytes_ > 0 && bytes_ + body->size() > most_) return false;
  holds_.emplace(body.get(), 1);
  bytes_ += body->size();
  return true;
}

void Unsent::release(const std::shared_ptr<const std::string>& body) noexcept {
  if (!isCounted(body)) return;
  const auto held = holds_.find(body.get());
  if (held == holds_.end() || --held->second > 0) return;
  bytes_ -= body->size();
  holds_.erase(held);
}

}  // namespace sgm::service::http
