#pragma once
// The head of an answer, as sent.

#include <string>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

/// The connection's part of an answer.
struct AnswerFrame {
  bool http11 = true;     ///< the request's version
  bool close = false;     ///< the connection ends with this answer
  std::string_view date;  ///< for the field Date; empty: omitted
};

/// Whether it is valid: a final status, and no field with a line break.
bool isSendable(const Response& response);

/// Whether an answer of that status may have a body (RFC 9112, 6.3).
bool mayHaveBody(int status);

/// From the status line to the empty line. Adds the fields that every answer has; response.fields may override
/// Cache-Control, Referrer-Policy and X-Content-Type-Options. The server sets the fields of framing (Connection,
/// Content-Length, Content-Type, Date, Transfer-Encoding), and ignores those in response.fields.
std::string answerHead(const Response& response, const AnswerFrame& frame);

/// For the field Date: "Sun, 06 Nov 1994 08:49:37 GMT", from seconds since 1970.
std::string httpDate(long long seconds);

}  // namespace sgm::service::http
