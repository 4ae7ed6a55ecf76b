#include "tools/service/http/request_reader.h"

#include <algorithm>
#include <utility>

namespace sgm::service::http {

RequestReader::Event RequestReader::next(std::string_view& bytes) {
  switch (state_) {
    case State::end:
      state_ = State::head;
      head_ = Head();
      [[fallthrough]];
    case State::head:
      if (auto problem = scanner_.scan(bytes)) return refuse(std::move(*problem));
      if (!scanner_.whole()) return Event::starved;
      if (auto problem = readHead(scanner_.text(), head_)) return refuse(std::move(*problem));
      scanner_.reset();
      head_.request.gone = gone_;
      max_bytes_ = 0;
      state_ = State::admitted;
      return Event::head;
    case State::admitted:
      if (auto problem = checkBody()) return refuse(std::move(*problem));
      if (!head_.hasBody()) {
        state_ = State::end;
        return Event::end;
      }
      state_ = State::body;
      to_come_ = head_.length.value_or(0);
      chunks_ = ChunkReader(max_bytes_);
      if (head_.expects_continue) return Event::go_on;
      [[fallthrough]];
    case State::body:
      return readBody(bytes);
    case State::refused:
      break;
  }
  return Event::refused;
}

RequestReader::Event RequestReader::readBody(std::string_view& bytes) {
  if (head_.chunked) {
    if (auto problem = chunks_.next(bytes, piece_)) return refuse(std::move(*problem));
    if (!piece_.empty()) return Event::piece;
    if (!chunks_.ended()) return Event::starved;
  } else if (to_come_ > 0) {
    if (bytes.empty()) return Event::starved;
    piece_ = bytes.substr(0, std::min<uint64_t>(to_come_, bytes.size()));
    bytes.remove_prefix(piece_.size());
    to_come_ -= piece_.size();
    return Event::piece;
  }
  state_ = State::end;
  return Event::end;
}

std::optional<Problem> RequestReader::checkBody() const {
  if (head_.expects_other)
    return Problem{417, "expectation_failed", "This server supports no expectation but 100-continue.", {}};
  if (head_.encoded_content)
    return Problem{415, "content_encoding", "Send the body as it is, without Content-Encoding.", {}};
  const std::string& method = head_.request.method;
  if (!head_.chunked && !head_.length && (method == "POST" || method == "PUT" || method == "PATCH"))
    return Problem{
        411, "length_required", "Give the length of the body with Content-Length, or send it in chunks.", {}};
  if (head_.length.value_or(0) > max_bytes_)
    return Problem{413, "too_large", "The body is larger than this path accepts.", {}};
  return std::nullopt;
}

RequestReader::Event RequestReader::refuse(Problem problem) {
  state_ = State::refused;
  scanner_.reset();
  refusal_ = std::move(problem);
  return Event::refused;
}

}  // namespace sgm::service::http
