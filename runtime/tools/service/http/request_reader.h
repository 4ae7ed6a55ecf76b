#pragma once
// Parses requests from the bytes of a connection, without sockets or clocks: the result depends only on the bytes, not
// on how they arrive in pieces.

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
    starved,  ///< all bytes are consumed, and more are needed
    head,     ///< request() is valid; call allow() before the next step
    go_on,    ///< the client waits for 100 (Continue) before it sends the body
    piece,    ///< piece() is the next piece of the body, never empty
    end,      ///< the request is complete; the next step starts the next one
    refused,  ///< refusal() is the problem; no further events
  };

  /// gone: for the requests (Request::gone).
  explicit RequestReader(const ReaderLimits& limits, std::shared_ptr<const std::atomic<bool>> gone = nullptr)
      : scanner_(limits), gone_(std::move(gone)) {}

  /// One step. Removes consumed bytes from `bytes`. Without bytes, returns a pending event, or starved.
  Event next(std::string_view& bytes);

  /// Valid from head to end.
  const Request& request() const { return head_.request; }
  /// The maximal size of an accepted body; 0 without a call. The next step rejects a body that is larger, that is
  /// encoded, or whose length is missing (POST, PUT, PATCH).
  void allow(uint64_t most_bytes) { most_bytes_ = most_bytes; }
  /// After head, for a request without a body that has been answered without its checks. The next step starts the next
  /// one.
  void finish() { state_ = State::end; }
  /// A part of the bytes passed to next().
  std::string_view piece() const { return piece_; }
  const Problem& refusal() const { return refusal_; }

  /// Between two requests, before the first byte of the next one.
  bool between() const { return state_ == State::head && !scanner_.begun(); }
  /// Whether a request's head is being read, or the reader waits for one.
  bool inHead() const { return state_ == State::head; }
  /// From head to end: whether the client sends a body.
  bool hasBody() const { return head_.hasBody(); }
  /// From head to end: whether another request may follow.
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
  uint64_t to_come_ = 0;  ///< remaining bytes of a body of known length
  ChunkReader chunks_{0};
  std::string_view piece_;
  Problem refusal_;
};

}  // namespace sgm::service::http
