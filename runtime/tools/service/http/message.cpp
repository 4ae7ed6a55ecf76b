#include "tools/service/http/message.h"

#include <algorithm>
#include <array>

#include "base/utf8.h"
#include "tools/service/http/ascii.h"

namespace sgm::service::http {

namespace {

std::string quoted(std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string out = "\"";
  while (!text.empty()) {
    const size_t size = utf8Size(text);
    const char c = text.front();
    if (size == 0) {
      out += "\\ufffd";  // replacement character for invalid UTF-8, which JSON must not contain
    } else if (c == '"' || c == '\\') {
      (out += '\\') += c;
    } else if (isControl(c)) {
      ((out += "\\u00") += kHex[static_cast<unsigned char>(c) >> 4]) += kHex[static_cast<unsigned char>(c) & 15];
    } else {
      out += text.substr(0, size);
    }
    text.remove_prefix(std::max<size_t>(size, 1));
  }
  return out += '"';
}

struct Reason {
  int status;
  std::string_view text;
};

constexpr auto kReasons = std::to_array<Reason>({
    {100, "Continue"},
    {200, "OK"},
    {201, "Created"},
    {202, "Accepted"},
    {204, "No Content"},
    {206, "Partial Content"},
    {301, "Moved Permanently"},
    {302, "Found"},
    {303, "See Other"},
    {304, "Not Modified"},
    {307, "Temporary Redirect"},
    {308, "Permanent Redirect"},
    {400, "Bad Request"},
    {401, "Unauthorized"},
    {403, "Forbidden"},
    {404, "Not Found"},
    {405, "Method Not Allowed"},
    {406, "Not Acceptable"},
    {408, "Request Timeout"},
    {409, "Conflict"},
    {410, "Gone"},
    {411, "Length Required"},
    {412, "Precondition Failed"},
    {413, "Content Too Large"},
    {414, "URI Too Long"},
    {415, "Unsupported Media Type"},
    {416, "Range Not Satisfiable"},
    {417, "Expectation Failed"},
    {421, "Misdirected Request"},
    {422, "Unprocessable Entity"},
    {429, "Too Many Requests"},
    {431, "Request Header Fields Too Large"},
    {500, "Internal Server Error"},
    {501, "Not Implemented"},
    {503, "Service Unavailable"},
    {504, "Gateway Timeout"},
    {505, "HTTP Version Not Supported"},
    {507, "Insufficient Storage"},
});

}  // namespace

std::optional<std::string_view> Request::field(std::string_view name) const {
  for (const Field& f : fields)
    if (sameLetters(f.name, name)) return f.value;
  return std::nullopt;
}

std::optional<std::string_view> Request::parameter(std::string_view name) const {
  for (const auto& [key, value] : query)
    if (key == name) return value;
  return std::nullopt;
}

Response makeResponse(int status, std::string type, std::string body) {
  Response response;
  response.status = status;
  response.type = std::move(type);
  response.body = std::make_shared<const std::string>(std::move(body));
  return response;
}

Response makeResponse(const Problem& problem) {
  std::string json = "{\"type\":\"about:blank\",\"title\":" + quoted(reasonOf(problem.status)) +
                     ",\"status\":" + std::to_string(problem.status) + ",\"code\":" + quoted(problem.code) +
                     ",\"detail\":" + quoted(problem.detail);
  if (!problem.pointer.empty()) json += ",\"pointer\":" + quoted(problem.pointer);
  return makeResponse(problem.status, "application/problem+json", json + "}\n");
}

std::string_view reasonOf(int status) {
  for (const Reason& reason : kReasons)
    if (reason.status == status) return reason.text;
  return "Unknown";
}

}  // namespace sgm::service::http
