#pragma once
// Parses the head of a request, once it is complete.

#include <cstdint>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

struct Head {
  Request request;
  bool http11 = true;
  bool keep_alive = true;  ///< as requested by the client
  bool chunked = false;
  std::optional<uint64_t> length;  ///< Content-Length; never together with chunked
  bool expects_continue = false;
  bool expects_other = false;    ///< an unknown expectation
  bool encoded_content = false;  ///< Content-Encoding other than identity

  bool hasBody() const { return chunked || length.value_or(0) > 0; }
};

/// text: from HeadScanner. Sets `head`, or returns the problem: 400, 501 for a Transfer-Encoding other than chunked, or
/// 505. Rejects everything that could make two parsers see different requests (request smuggling): both lengths, or one
/// of them twice, a space after a field's name, HTTP/1.0 with chunks.
std::optional<Problem> readHead(std::string_view text, Head& head);

}  // namespace sgm::service::http
