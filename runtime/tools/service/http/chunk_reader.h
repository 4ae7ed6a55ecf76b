#pragma once
// Parses a chunked body (RFC 9112, 7.1) byte by byte, so the result does not depend on how the bytes arrive in pieces.

#include <cstdint>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

class ChunkReader {
 public:
  /// most_bytes: limit of the decoded body; a chunk that exceeds it gives a 413 before it is read.
  explicit ChunkReader(uint64_t most_bytes) : room_(most_bytes) {}

  /// Consumes bytes up to the next piece of the body or its end, and removes them from `bytes`. piece: empty if neither
  /// is reached; otherwise a part of `bytes`. Must not be called again after a problem.
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
  uint64_t room_;          ///< bytes that the body may still have
  uint64_t in_chunk_ = 0;  ///< remaining bytes of the current chunk
  uint32_t digits_ = 0;
  uint32_t beside_ = 0;  ///< bytes of extensions and trailers, which are ignored
};

}  // namespace sgm::service::http
