#include "tools/service/http/target.h"

#include <algorithm>
#include <string>

#include "base/utf8.h"
#include "tools/service/http/ascii.h"

namespace sgm::service::http {

namespace {

Problem badTarget(const char* detail) { return {400, "bad_request", detail, {}}; }

/// Decodes percent escapes. Returns nullopt if an escape is invalid, or if the result is not UTF-8 or has control
/// characters.
std::optional<std::string> decoded(std::string_view text, bool plus_is_space) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      const int high = i + 1 < text.size() ? hexValue(text[i + 1]) : -1;
      const int low = i + 2 < text.size() ? hexValue(text[i + 2]) : -1;
      if (high < 0 || low < 0) return std::nullopt;
      c = static_cast<char>(high * 16 + low);
      i += 2;
    } else if (c == '+' && plus_is_space) {
      c = ' ';
    }
    out += c;
  }
  for (std::string_view rest = out; !rest.empty();) {
    const size_t size = utf8Size(rest);
    if (size == 0 || isControl(rest[0])) return std::nullopt;
    // U+0080 to U+009F are control characters as well.
    if (rest[0] == '\xC2' && static_cast<unsigned char>(rest[1]) < 0xA0) return std::nullopt;
    rest.remove_prefix(size);
  }
  return out;
}

std::optional<Problem> readPath(std::string_view text, std::string& path) {
  path.clear();
  for (size_t begin = 1; begin <= text.size();) {
    const size_t end = std::min(text.find('/', begin), text.size());
    const std::optional<std::string> segment = decoded(text.substr(begin, end - begin), false);
    if (!segment) return badTarget("The path must be percent-encoded UTF-8 without control characters.");
    if (segment->find_first_of("/\\") != std::string::npos)
      return badTarget("A segment of the path must not have a slash or a backslash.");
    if (*segment == "." || *segment == "..") return badTarget("The path must not have the segments . and ..");
    if (segment->empty() && end < text.size()) return badTarget("The path must not have empty segments.");
    (path += '/') += *segment;
    begin = end + 1;
  }
  return std::nullopt;
}

std::optional<Problem> readQuery(std::string_view text, Request& request) {
  request.query.clear();
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find('&', begin), text.size());
    const std::string_view parameter = text.substr(begin, end - begin);
    begin = end + 1;
    if (parameter.empty()) continue;
    if (request.query.size() == kMaxParameters) return badTarget("The query has too many parameters.");
    const size_t equals = std::min(parameter.find('='), parameter.size());
    std::optional<std::string> name = decoded(parameter.substr(0, equals), true);
    std::optional<std::string> value = decoded(parameter.substr(std::min(equals + 1, parameter.size())), true);
    if (!name || !value) return badTarget("The query must be percent-encoded UTF-8 without control characters.");
    request.query.emplace_back(std::move(*name), std::move(*value));
  }
  return std::nullopt;
}

}  // namespace

std::optional<Problem> readTarget(std::string_view target, std::optional<std::string_view> host, Request& request) {
  constexpr std::string_view kScheme = "http://";
  if (sameLetters(target.substr(0, kScheme.size()), kScheme)) {
    target.remove_prefix(kScheme.size());
    const std::string_view authority = target.substr(0, target.find_first_of("/?#"));
    if (authority.empty() || !host || !sameLetters(authority, *host))
      return badTarget("The host of the request's target must be that of the field Host.");
    target.remove_prefix(authority.size());
  } else if (target.empty() || target.front() != '/') {
    return badTarget("The request's target must be a path that begins with a slash.");
  }
  if (target.find('#') != std::string_view::npos) return badTarget("The request's target must not have a fragment.");
  const size_t mark = std::min(target.find('?'), target.size());
  const std::string_view path = target.substr(0, mark);
  if (auto problem = readPath(path.empty() ? "/" : path, request.path)) return problem;
  return readQuery(target.substr(std::min(mark + 1, target.size())), request);
}

}  // namespace sgm::service::http
