#pragma once
// Parses a chunked HTTP body (RFC 9112, 7.1) byte by byte. The result does not depend on how the bytes are split on
// arrival.

#include <cstdint>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

class ChunkReader {
 public:
  /// max_bytes: limit of the decoded body. A chunk that would exceed the limit gives a 413 as soon as its size is
  /// known.
  explicit ChunkReader(uint64_t max_bytes) : room_(max_bytes) {}

  /// Consumes bytes up to the end of the next piece of the body, or of the whole body, and removes them from `bytes`.
  /// Sets `piece` to the part of `bytes` that belongs to the body; it may be empty. Must not be called again after it
  /// has returned a problem.
  std::optional<Problem> next(std::string_view& bytes, std::string_view& piece);
  bool ended() const { return state_ == State::ended; }

 private:
  enum class State {
    size,
    after_size,
    extension,
    size_end,
    data,
    data_return,
    data_end,
    trailer_begin,
    trailer,
    trailer_end,
    last_end,
    ended
  };
  std::optional<Problem> take(char c);
  std::optional<Problem> endSize();

  State state_ = State::size;
  uint64_t room_;          ///< number of bytes that the decoded body may still grow by
  uint64_t in_chunk_ = 0;  ///< number of bytes of the current chunk that have not arrived yet
  uint32_t digits_ = 0;
  uint32_t beside_ = 0;  ///< number of bytes of chunk extensions and trailers so far; at most kMaxFraming
};

}  // namespace sgm::service::http
