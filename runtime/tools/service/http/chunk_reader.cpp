#include "tools/service/http/chunk_reader.h"

#include <algorithm>

#include "tools/service/http/ascii.h"

namespace sgm::service::http {

namespace {

/// Maximum total number of bytes of chunk extensions and trailers in one body.
constexpr uint32_t kMaxFraming = 4096;

/// Maximum number of hexadecimal digits of a chunk's size: 16 digits are 64 bits.
constexpr uint32_t kMaxDigits = 16;

Problem badChunk() { return {400, "bad_request", "The chunks of the body are not valid HTTP.", {}}; }

}  // namespace

std::optional<Problem> ChunkReader::next(std::string_view& bytes, std::string_view& piece) {
  piece = {};
  while (!bytes.empty() && state_ != State::ended) {
    if (state_ == State::data) {
      piece = bytes.substr(0, std::min<uint64_t>(in_chunk_, bytes.size()));
      bytes.remove_prefix(piece.size());
      in_chunk_ -= piece.size();
      if (in_chunk_ == 0) state_ = State::data_return;
      return std::nullopt;
    }
    const char c = bytes.front();
    bytes.remove_prefix(1);
    if (auto problem = take(c)) return problem;
  }
  return std::nullopt;
}

std::optional<Problem> ChunkReader::take(char c) {
  const auto expect = [&](char wanted, State then) -> std::optional<Problem> {
    if (c != wanted) return badChunk();
    state_ = then;
    return std::nullopt;
  };
  const auto ignore = [&]() -> std::optional<Problem> {
    if (isControl(c) && c != '\t') return badChunk();
    if (++beside_ > kMaxFraming)
      return Problem{431,
                     "header_too_large",
                     "The chunks of the body have longer extensions and trailers than this server reads.",
                     {}};
    return std::nullopt;
  };
  switch (state_) {
    case State::size:
      if (const int digit = hexValue(c); digit >= 0) {
        if (++digits_ > kMaxDigits) return badChunk();
        in_chunk_ = in_chunk_ * 16 + static_cast<uint64_t>(digit);
        return std::nullopt;
      }
      if (digits_ == 0) return badChunk();
      if (c == '\r') return expect('\r', State::size_end);
      state_ = State::after_size;
      [[fallthrough]];
    case State::after_size:
      // Accept spaces after the size only before an extension. Parsers disagree about other spaces, which allows
      // request smuggling.
      if (c == ';')
        state_ = State::extension;
      else if (c != ' ' && c != '\t')
        return badChunk();
      return ignore();
    case State::extension:
      return c == '\r' ? expect('\r', State::size_end) : ignore();
    case State::size_end:
      if (c != '\n') return badChunk();
      return endSize();
    case State::data_return:
      return expect('\r', State::data_end);
    case State::data_end:
      return expect('\n', State::size);
    case State::trailer_begin:
      if (c == '\r') return expect('\r', State::last_end);
      state_ = State::trailer;
      return ignore();
    case State::trailer:
      return c == '\r' ? expect('\r', State::trailer_end) : ignore();
    case State::trailer_end:
      return expect('\n', State::trailer_begin);
    case State::last_end:
      return expect('\n', State::ended);
    case State::data:
    case State::ended:
      break;
  }
  return badChunk();
}

std::optional<Problem> ChunkReader::endSize() {
  digits_ = 0;
  if (in_chunk_ > room_) return Problem{413, "too_large", "The body is larger than this path accepts.", {}};
  room_ -= in_chunk_;
  state_ = in_chunk_ > 0 ? State::data : State::trailer_begin;
  return std::nullopt;
}

}  // namespace sgm::service::http
