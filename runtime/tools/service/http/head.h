#pragma once
// What the head of a request says, once it is there as a whole.

#include <cstdint>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

struct Head {
  Request request;
  bool http11 = true;
  bool keep_alive = true;  ///< as the client wishes
  bool chunked = false;
  std::optional<uint64_t> length;  ///< Content-Length; never with chunked
  bool expects_continue = false;
  bool expects_other = false;    ///< what no server knows
  bool encoded_content = false;  ///< Content-Encoding other than identity

  bool hasBody() const { return chunked || length.value_or(0) > 0; }
};

/// `text` is what HeadScanner has found. Writes head, or says why it is refused: 400, 501 for a Transfer-Encoding other
/// than chunked, 505. Everything by which two readers could take a request for two different ones is refused: both
/// lengths, or one of them twice, a field's name with a space behind it, HTTP/1.0 with chunks.
std::optional<Problem> readHead(std::string_view text, Head& head);

}  // namespace sgm::service::http
