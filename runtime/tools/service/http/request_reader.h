#pragma once
// Parses requests from the bytes of a connection, without sockets or clocks. The result depends only on the bytes, not
// on how they are split into pieces on arrival.

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
    starved,  ///< all bytes are consumed, and more bytes are needed
    head,     ///< request() is valid; the caller must call allow() or finish() before the next step
    go_on,    ///< the client waits for 100 (Continue) before it sends the body
    piece,    ///< piece() is the next piece of the body, never empty
    end,      ///< the request is complete; the next step begins with the next request
    refused,  ///< refusal() is the problem; no further events follow
  };

  /// gone: flag for Request::gone of all requests.
  explicit RequestReader(const ReaderLimits& limits, std::shared_ptr<const std::atomic<bool>> gone = nullptr)
      : scanner_(limits), gone_(std::move(gone)) {}

  /// Performs one step, and removes the consumed bytes from `bytes`. If `bytes` is empty, returns a pending event, or
  /// starved.
  Event next(std::string_view& bytes);

  /// The current request; valid from Event::head to Event::end.
  const Request& request() const { return head_.request; }
  /// Sets the limit of the body in bytes, after Event::head; without a call the limit is 0. The next step rejects a
  /// body that is larger, that has a Content-Encoding, or whose length is missing (POST, PUT, PATCH).
  void allow(uint64_t max_bytes) { max_bytes_ = max_bytes; }
  /// May be called after Event::head instead of allow(), for a request without a body that has already been answered.
  /// The next step begins with the next request.
  void finish() { state_ = State::end; }
  /// The piece of the body at Event::piece: a part of the bytes passed to next().
  std::string_view piece() const { return piece_; }
  const Problem& refusal() const { return refusal_; }

  /// Whether the reader is between two requests: no byte of the next request has been consumed.
  bool between() const { return state_ == State::head && !scanner_.begun(); }
  /// Whether the head of a request is being read, or has yet to begin.
  bool inHead() const { return state_ == State::head; }
  /// Whether the request has a body. Valid from Event::head to Event::end.
  bool hasBody() const { return head_.hasBody(); }
  /// Whether another request may follow on this connection. Valid from Event::head to Event::end.
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
  uint64_t max_bytes_ = 0;
  uint64_t to_come_ = 0;  ///< number of bytes that have not arrived, for a body of known length
  ChunkReader chunks_{0};
  std::string_view piece_;
  Problem refusal_;
};

}  // namespace sgm::service::http
