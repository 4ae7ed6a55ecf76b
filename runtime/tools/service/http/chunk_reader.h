#pragma once
// A body in chunks (RFC 9112, 7.1), taken apart byte by byte: it means the same however it was cut on its way.

#include <cstdint>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

class ChunkReader {
 public:
  /// most_bytes: of what the chunks hold; more is a 413, said before it is read.
  explicit ChunkReader(uint64_t most_bytes) : room_(most_bytes) {}

  /// Takes bytes up to the next piece of the body or its end; `bytes` loses what was taken. Empty: neither is there
  /// yet. piece points into `bytes`. A refusal is the last thing it says.
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
  uint64_t room_;          ///< what the body may still hold
  uint64_t in_chunk_ = 0;  ///< of the chunk's bytes, those to come
  uint32_t digits_ = 0;
  uint32_t beside_ = 0;  ///< bytes of extensions and trailers, which nothing here reads
};

}  // namespace sgm::service::http
