#pragma once
// Writes the head of an HTTP answer as it is sent.

#include <string>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

/// Properties of an answer that its connection determines, not its handler.
struct AnswerFrame {
  bool http11 = true;     ///< the version of the request is HTTP/1.1; otherwise HTTP/1.0
  bool close = false;     ///< the connection closes after this answer
  std::string_view date;  ///< value of the field Date; empty: the field is omitted
};

/// Whether the answer can be sent: its status is final (not 1xx), and no field contains a line break.
bool isSendable(const Response& response);

/// Whether an answer of that status may have a body (RFC 9112, 6.3).
bool mayHaveBody(int status);

/// The bytes of the head, from the status line to the empty line. Adds the fields that every answer has;
/// response.fields may override Cache-Control, Referrer-Policy and X-Content-Type-Options. Sets the fields of framing
/// (Connection, Content-Length, Content-Type, Date, Transfer-Encoding), and ignores them in response.fields.
std::string answerHead(const Response& response, const AnswerFrame& frame);

/// The time in the form of the field Date, "Sun, 06 Nov 1994 08:49:37 GMT". seconds: since 1970.
std::string httpDate(long long seconds);

}  // namespace sgm::service::http
