#pragma once
// Formats the head of an HTTP answer.

#include <string>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

/// Properties of an answer that the connection determines, not the handler that makes the answer.
struct AnswerFrame {
  bool http11 = true;     ///< whether the request's version is HTTP/1.1; otherwise it is HTTP/1.0
  bool close = false;     ///< whether the connection closes after this answer
  std::string_view date;  ///< value of the header Date; if empty, the header is omitted
};

/// Whether the answer can be sent: its status is final (not 1xx), and no header contains a line break.
bool isSendable(const Response& response);

/// Whether an answer with this status may have a body (RFC 9112, 6.3).
bool mayHaveBody(int status);

/// The bytes of the answer's head, from the status line to the empty line. Adds the headers that every answer has;
/// response.fields may override Cache-Control, Referrer-Policy and X-Content-Type-Options. Sets Connection,
/// Content-Length, Content-Type, Date and Transfer-Encoding itself, and ignores them in response.fields.
std::string answerHead(const Response& response, const AnswerFrame& frame);

/// A time in the format of the header Date, "Sun, 06 Nov 1994 08:49:37 GMT". seconds: since the start of 1970, UTC.
std::string httpDate(long long seconds);

}  // namespace sgm::service::http
