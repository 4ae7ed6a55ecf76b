#pragma once
// Parses a chunked body (RFC 9112, 7.1) byte by byte, so that the result does not depend on how the bytes are split
// into pieces on arrival.

#include <cstdint>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

class ChunkReader {
 public:
  /// max_bytes: limit of the decoded body. A chunk that would exceed it gives a 413 before the chunk is read.
  explicit ChunkReader(uint64_t max_bytes) : room_(max_bytes) {}

  /// Consumes bytes up to the end of the next piece of the body or of the whole body, and removes them from `bytes`.
  /// Sets `piece` to a part of `bytes`, or to empty if no byte of the body was found. Must not be called again after it
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
  uint64_t room_;          ///< number of bytes that the body may still have
  uint64_t in_chunk_ = 0;  ///< number of bytes of the current chunk that have not arrived
  uint32_t digits_ = 0;
  uint32_t beside_ = 0;  ///< number of bytes of chunk extensions and trailers so far, which are ignored but limited
};

}  // namespace sgm::service::http
