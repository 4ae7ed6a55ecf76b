#pragma once
// A handler whose answers depend on the paths of requests.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tools/service/http/handler.h"

namespace sgm::service::http {

/// Keeps a request's body. Rejects the body midway if it contains "STOP", and throws an exception if it contains
/// "THROW".
class TestBody : public Body {
 public:
  std::optional<Response> take(std::string_view piece) override {
    bytes += piece;
    if (bytes.find("STOP") != std::string::npos) return makeResponse({422, "bad_input", "It says STOP.", "/0"});
    if (bytes.find("THROW") != std::string::npos) throw std::runtime_error("a body");
    return std::nullopt;
  }
  std::string bytes;
};

class TestHandler : public Handler {
 public:
  static constexpr uint64_t kMaxBytes = 1000;

  Admission admit(const Request& request) override {
    Admission admission;
    if (request.path == "/throw/admit") throw std::runtime_error("admit");
    if (request.path == "/forbidden") admission.refusal = makeResponse({403, "foreign_origin", "No.", {}});
    if (request.method == "POST" || request.method == "PUT") {
      admission.body = std::make_unique<TestBody>();
      admission.max_bytes = request.path == "/large" ? uint64_t{1} << 40 : kMaxBytes;
    }
    return admission;
  }

  void answer(const Request& request, std::unique_ptr<Body> body, Reply reply) override {
    const auto* taken = static_cast<const TestBody*>(body.get());
    if (request.path == "/throw") throw std::runtime_error("answer");
    if (request.path == "/drop") return;
    if (request.path == "/twice") reply(makeResponse(200, "text/plain", "first"));
    if (request.path == "/split") return reply({200, "text/plain", {{"X-A", "a\r\nX-B: b"}}, nullptr, false});
    if (request.path == "/bye") return reply({200, "", {}, nullptr, true});
    if (request.path == "/empty") return reply({204, "", {}, nullptr, false});
    if (request.path == "/cached") return reply({200, "", {{"Cache-Control", "no-cache"}}, nullptr, false});
    if (request.path == "/big") return reply(makeResponse(200, "text/plain", std::string(size_t{32} << 20, 'b')));
    if (request.path == "/later") {
      const std::lock_guard lock(mutex_);
      kept_.push_back(std::move(reply));
      last_gone_ = request.gone;
      changed_.notify_all();
      return;
    }
    reply(makeResponse(200, "text/plain", request.method + " " + request.path + " " + (taken ? taken->bytes : "")));
  }

  /// Returns the Reply of the next request for /later, with which the test can answer this request. Waits at most for
  /// `time`; returns null if no such request arrives.
  Reply takeReplyWithin(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, time, [&] { return !kept_.empty(); })) return nullptr;
    Reply reply = std::move(kept_.front());
    kept_.erase(kept_.begin());
    return reply;
  }
  Reply takeReply() {
    Reply reply = takeReplyWithin(std::chrono::seconds(10));
    if (!reply) throw std::runtime_error("no request of /later came");
    return reply;
  }

  /// Returns the flag Request::gone of the last request for /later. It becomes true when the client disconnects.
  std::shared_ptr<const std::atomic<bool>> lastGone() {
    const std::lock_guard lock(mutex_);
    return last_gone_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Reply> kept_;
  std::shared_ptr<const std::atomic<bool>> last_gone_;
};

}  // namespace sgm::service::http
