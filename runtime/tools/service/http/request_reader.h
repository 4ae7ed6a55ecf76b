#pragma once
// Requests out of the bytes of a connection. It knows neither sockets nor clocks: what it says depends on the bytes
// alone, not on how they were cut on their way.

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "tools/service/http/chunk_reader.h"
#include "tools/service/http/head.h"
#include "tools/service/http/head_scanner.h"
#include "tools/service/http/message.h"

namespace sgm::service::http {

class RequestReader {
 public:
  enum class Event {
    starved,  ///< all bytes are taken, and more are needed
    head,     ///< request() is there; allow() is to be called before the next step
    go_on,    ///< the client waits for 100 (Continue) before it sends the body
    piece,    ///< piece() is the next one of the body, never empty
    end,      ///< the request is whole; the next step begins the next one
    refused,  ///< refusal() says why; nothing else follows
  };

  /// gone: for the requests (Request::gone).
  explicit RequestReader(const ReaderLimits& limits, std::shared_ptr<const std::atomic<bool>> gone = nullptr)
      : scanner_(limits), gone_(std::move(gone)) {}

  /// One step. `bytes` loses what was taken. Without bytes it says what is known already, or that it is starved.
  Event next(std::string_view& bytes);

  /// From head to end.
  const Request& request() const { return head_.request; }
  /// How large a body may be that is wanted; none is where this is not called. A body that is larger, whose length the
  /// client does not say (POST, PUT, PATCH), or that is encoded, is refused in the next step.
  void allow(uint64_t most_bytes) { most_bytes_ = most_bytes; }
  /// After head, of a request without a body: it is answered, whatever it asked for. The next step begins the next one.
  void finish() { state_ = State::end; }
  /// Into the bytes that next() was given.
  std::string_view piece() const { return piece_; }
  const Problem& refusal() const { return refusal_; }

  /// Between two requests, with no byte of the next one.
  bool between() const { return state_ == State::head && !scanner_.begun(); }
  /// Is a request's head being read, or about to be?
  bool inHead() const { return state_ == State::head; }
  /// From head to end: does the client send a body?
  bool hasBody() const { return head_.hasBody(); }
  /// From head to end: may another request follow?
  bool keepAlive() const { return head_.keep_alive; }
  bool http11() const { return head_.http11; }

 private:
  enum class State { head, admitted, body, end, refused };
  Event readBody(std::string_view& bytes);
  Event refuse(Problem problem);
  std::optional<Problem> checkBody() const;

  HeadScanner scanner_;
  std::shared_ptr<const std::atomic<bool>> gone_;
  Head head_;
  State state_ = State::head;
  uint64_t most_bytes_ = 0;
  uint64_t to_come_ = 0;  ///< of a body of known length
  ChunkReader chunks_{0};
  std::string_view piece_;
  Problem refusal_;
};

}  // namespace sgm::service::http
