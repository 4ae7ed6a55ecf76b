#pragma once
// Parses the complete head of an HTTP request.

#include <cstdint>
#include <optional>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

struct Head {
  Request request;
  bool http11 = true;
  bool keep_alive = true;  ///< whether the connection stays open after the answer
  bool chunked = false;
  std::optional<uint64_t> length;  ///< value of Content-Length; not set together with `chunked`
  bool expects_continue = false;
  bool expects_other = false;    ///< whether the header Expect has a value other than 100-continue
  bool encoded_content = false;  ///< whether Content-Encoding has a value other than identity

  bool hasBody() const { return chunked || length.value_or(0) > 0; }
};

/// Parses `text`, a head that HeadScanner has found. Sets `head`, or returns the problem: 400, 501 for a
/// Transfer-Encoding other than chunked, or 505. Rejects all heads that two parsers could understand differently, to
/// prevent request smuggling: both Content-Length and Transfer-Encoding, a duplicate of either, a space after a
/// header's name, and chunks in HTTP/1.0.
std::optional<Problem> readHead(std::string_view text, Head& head);

}  // namespace sgm::service::http
