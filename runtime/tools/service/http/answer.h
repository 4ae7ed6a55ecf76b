#pragma once
// The head of an answer, as it goes over the line.

#include <string>
#include <string_view>

#include "tools/service/http/message.h"

namespace sgm::service::http {

/// What of an answer the connection decides.
struct AnswerFrame {
  bool http11 = true;     ///< the request's version
  bool close = false;     ///< the connection ends with this answer
  std::string_view date;  ///< for the field Date; empty: left out
};

/// May it be sent: a final status, and fields that stay within their lines?
bool isSendable(const Response& response);

/// May an answer of that status have a body (RFC 9112, 6.3)?
bool mayHaveBody(int status);

/// From the status line to the empty line. Writes the fields that every answer has, but for Cache-Control,
/// Referrer-Policy and X-Content-Type-Options where response.fields has them. Those of framing (Connection,
/// Content-Length, Content-Type, Date, Transfer-Encoding) are the server's: in response.fields they are passed over.
std::string answerHead(const Response& response, const AnswerFrame& frame);

/// For the field Date: "Sun, 06 Nov 1994 08:49:37 GMT", of seconds since 1970.
std::string httpDate(long long seconds);

}  // namespace sgm::service::http
