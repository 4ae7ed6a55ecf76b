#include "tools/service/http/head.h"

#include <algorithm>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <charconv>

#include "tools/service/http/ascii.h"
#include "tools/service/http/target.h"

namespace sgm::service::http {

namespace {

namespace beast = boost::beast;

Problem badRequest(const char* detail) { return {400, "bad_request", detail, {}}; }

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Checks the HTTP version first, since the target may have another syntax in other versions.
std::optional<Problem> checkVersion(std::string_view line) {
  const std::string_view version = line.substr(line.rfind(' ') + 1);
  const bool is_version = version.size() == 8 && version.substr(0, 5) == "HTTP/" && isDigit(version[5]) &&
                          version[6] == '.' && isDigit(version[7]);
  if (!is_version || std::count(line.begin(), line.end(), ' ') != 2)
    return badRequest("The request line must be a method, a target and a version, with one space between each.");
  if (version != "HTTP/1.1" && version != "HTTP/1.0")
    return Problem{505, "http_version", "This server speaks HTTP/1.1 and HTTP/1.0.", {}};
  return std::nullopt;
}

size_t countOf(const Request& request, std::string_view name) {
  return static_cast<size_t>(std::count_if(request.fields.begin(), request.fields.end(),
                                           [&](const Field& f) { return sameLetters(f.name, name); }));
}

std::optional<Problem> readLength(Head& head) {
  const Request& request = head.request;
  const size_t lengths = countOf(request, "Content-Length"), encodings = countOf(request, "Transfer-Encoding");
  if (lengths > 1 || encodings > 1 || (lengths > 0 && encodings > 0))
    return badRequest("The length of the body must be given once, by Content-Length or by Transfer-Encoding.");
  if (encodings > 0) {
    if (!head.http11) return badRequest("HTTP/1.0 has no Transfer-Encoding.");
    if (!sameLetters(*request.field("Transfer-Encoding"), "chunked"))
      return Problem{501, "transfer_encoding", "This server supports no Transfer-Encoding but chunked.", {}};
    head.chunked = true;
  }
  if (lengths > 0) {
    const std::string_view text = *request.field("Content-Length");
    uint64_t length = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
    if (error != std::errc() || end != text.data() + text.size())
      return badRequest("Content-Length must be a whole number.");
    head.length = length;
  }
  return std::nullopt;
}

std::optional<Problem> checkHost(const Head& head) {
  const size_t hosts = countOf(head.request, "Host");
  if (hosts > 1 || (hosts == 0 && head.http11)) return badRequest("The request must have the field Host once.");
  if (hosts == 0) return std::nullopt;
  const std::string_view host = *head.request.field("Host");
  const bool is_host = std::all_of(host.begin(), host.end(), [](char c) {
    return isDigit(c) || (lowerLetter(c) >= 'a' && lowerLetter(c) <= 'z') ||
           std::string_view("-._~%!$&'()*+;=:[]").find(c) != std::string_view::npos;
  });
  if (!is_host) return badRequest("The field Host must be a name or an address, with or without a port.");
  return std::nullopt;
}

}  // namespace

std::optional<Problem> readHead(std::string_view text, Head& head) {
  const std::string_view line = text.substr(0, text.find('\r'));
  if (auto problem = checkVersion(line)) return problem;

  beast::http::request_parser<beast::http::empty_body> parser;
  parser.header_limit(static_cast<uint32_t>(std::min<size_t>(text.size(), UINT32_MAX)));
  parser.body_limit(UINT64_MAX);  // Switches off Beast's own limit, because RequestReader checks the body's length.
                                  // (With Beast's value for "no limit", every length would be rejected.)
  beast::error_code error;
  parser.put(boost::asio::const_buffer(text.data(), text.size()), error);
  if (error || !parser.is_header_done()) return badRequest("The request's header is not valid HTTP.");

  head = Head();
  head.http11 = parser.get().version() == 11;
  head.keep_alive = parser.keep_alive();
  head.request.method = view(parser.get().method_string());
  for (const auto& field : parser.get())
    head.request.fields.push_back({std::string(view(field.name_string())), std::string(view(field.value()))});

  if (auto problem = checkHost(head)) return problem;
  if (auto problem = readLength(head)) return problem;
  if (head.request.method == "CONNECT") return badRequest("This server is not a proxy.");
  if (auto problem = readTarget(view(parser.get().target()), head.request.field("Host"), head.request)) return problem;

  // HTTP/1.0 has no status 100 (Continue), so 100-continue is ignored in such a request (RFC 9110, 10.1.1).
  if (const auto expectation = head.request.field("Expect")) {
    const bool known = sameLetters(*expectation, "100-continue") && countOf(head.request, "Expect") == 1;
    head.expects_continue = known && head.http11;
    head.expects_other = !known;
  }
  head.encoded_content = std::any_of(head.request.fields.begin(), head.request.fields.end(), [](const Field& f) {
    return sameLetters(f.name, "Content-Encoding") && !sameLetters(f.value, "identity");
  });
  return std::nullopt;
}

}  // namespace sgm::service::http
