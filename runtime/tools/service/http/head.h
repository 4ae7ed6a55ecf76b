#pragma once
// Parses the complete head of a request.

#include <cstdint>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

struct Head {
  Request request;
  bool http11 = true;
  bool keep_alive = true;  ///< the client requests that the connection stays open
  bool chunked = false;
  std::optional<uint64_t> length;  ///< value of Content-Length; never set together with `chunked`
  bool expects_continue = false;
  bool expects_other = false;    ///< the field Expect has another value
  bool encoded_content = false;  ///< Content-Encoding is something other than identity

  bool hasBody() const { return chunked || length.value_or(0) > 0; }
};

/// Parses `text`, which HeadScanner has found. Sets `head`, or returns the problem: 400, 501 for a Transfer-Encoding
/// other than chunked, or 505. Rejects everything that could make two parsers see different requests (request
/// smuggling): Content-Length together with Transfer-Encoding, either of them twice, a space after a field's name,
/// HTTP/1.0 with chunks.
std::optional<Problem> readHead(std::string_view text, Head& head);

}  // namespace sgm::service::http
