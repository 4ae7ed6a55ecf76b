#pragma once
// Parses HTTP requests from the bytes of a connection; uses no sockets and no clocks. The result depends only on the
// bytes, not on how they are split on arrival.

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
    starved,  ///< all bytes have been consumed, and more are needed
    head,     ///< request() is valid; before it calls next() again, the caller may call allow() to get a body, or
              ///< finish()
    go_on,    ///< the client waits for a 100 (Continue) before it sends the body
    piece,    ///< piece() is the next piece of the body, not empty
    end,      ///< the request is complete; next() continues with the next request
    refused,  ///< refusal() is the problem; no other events follow
  };

  /// gone: flag that every request gets as Request::gone; may be null.
  explicit RequestReader(const ReaderLimits& limits, std::shared_ptr<const std::atomic<bool>> gone = nullptr)
      : scanner_(limits), gone_(std::move(gone)) {}

  /// Advances to the next event and removes the consumed bytes from `bytes`. With empty `bytes`, returns a pending
  /// event or starved.
  Event next(std::string_view& bytes);

  /// The current request; valid from Event::head to Event::end.
  const Request& request() const { return head_.request; }
  /// Sets the maximum size of the body in bytes; may be called after Event::head. Without this call, the maximum is 0.
  /// The following call of next() rejects the request if its body is too large or has a Content-Encoding, or if a POST,
  /// PUT or PATCH request does not state the length of its body.
  void allow(uint64_t max_bytes) { max_bytes_ = max_bytes; }
  /// May be called after Event::head, instead of allow(), if a request without a body has already been answered. next()
  /// then continues with the next request.
  void finish() { state_ = State::end; }
  /// The piece of the body after Event::piece: a part of the bytes that were passed to next().
  std::string_view piece() const { return piece_; }
  const Problem& refusal() const { return refusal_; }

  /// Whether no request has begun: no byte of the next head has been consumed.
  bool between() const { return state_ == State::head && !scanner_.begun(); }
  /// Whether the reader expects the beginning or the rest of a head.
  bool inHead() const { return state_ == State::head; }
  /// Whether the current request has a body. Valid from Event::head to Event::end.
  bool hasBody() const { return head_.hasBody(); }
  /// Whether another request may follow on the connection. Valid from Event::head to Event::end.
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
  uint64_t to_come_ = 0;  ///< number of bytes of the body that have not arrived yet, if its length is known
  ChunkReader chunks_{0};
  std::string_view piece_;
  Problem refusal_;
};

}  // namespace sgm::service::http
