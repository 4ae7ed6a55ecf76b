#include "tools/service/http/head_scanner.h"

#include "tools/service/http/ascii.h"

namespace sgm::service::http {

namespace {

Problem badHead(const char* detail) { return {400, "bad_request", detail, {}}; }

}  // namespace

std::optional<Problem> HeadScanner::scan(std::string_view& bytes) {
  size_t taken = 0;
  std::optional<Problem> refusal;
  while (taken < bytes.size() && !whole_ && !refusal) refusal = take(bytes[taken++]);
  bytes.remove_prefix(taken);
  return refusal;
}

std::optional<Problem> HeadScanner::take(char c) {
  begun_ = true;
  const bool request_line = lines_ == 0;
  if (text_.size() == limits_.head_bytes) {
    if (request_line) return Problem{414, "target_too_long", "The request line is longer than this server reads.", {}};
    return Problem{431, "header_too_large", "The header is longer than this server reads.", {}};
  }
  text_ += c;
  if (after_return_) {
    after_return_ = false;
    if (c != '\n') return badHead("A carriage return must be followed by a line feed.");
    return endLine();
  }
  if (c == '\r') {
    after_return_ = true;
    return std::nullopt;
  }
  if (c == '\n') return badHead("A line must end with a carriage return and a line feed.");
  if (isControl(c) && (c != '\t' || request_line)) return badHead("The header has a control character.");
  if (request_line && static_cast<unsigned char>(c) >= 0x80)
    return badHead("The request line must be ASCII; percent-encode other characters.");
  if (!request_line && line_bytes_ == 0) {
    if (c == ' ' || c == '\t') return badHead("A header field must not be folded over several lines.");
    if (lines_ > limits_.fields)
      return Problem{431, "header_too_large", "The header has more fields than this server reads.", {}};
  }
  if (++line_bytes_ <= limits_.line_bytes) return std::nullopt;
  if (request_line) return Problem{414, "target_too_long", "The request line is longer than this server reads.", {}};
  return Problem{431, "header_too_large", "A header field is longer than this server reads.", {}};
}

std::optional<Problem> HeadScanner::endLine() {
  if (line_bytes_ == 0 && lines_ == 0) {
    // Accept one empty line before the request line (RFC 9112, 2.2): old clients send it after the previous body.
    if (skipped_line_) return badHead("The request line is missing.");
    skipped_line_ = true;
    text_.clear();
    return std::nullopt;
  }
  whole_ = line_bytes_ == 0;
  line_bytes_ = 0;
  ++lines_;
  return std::nullopt;
}

}  // namespace sgm::service::http
