// `sgm lsp`: runs the language server on standard input and output.

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <limits>
#include <optional>
#include <string>

#include "tools/cli/serve/commands.h"
#include "tools/language/lsp_server.h"
#include "tools/support/console.h"

namespace sgm::cli {
namespace {

constexpr uint64_t kMaxBytes = uint64_t{64} << 20;  // maximum size of the content of a message
constexpr size_t kMaxHeaderBytes = 64 << 10;        // maximum total size of the header lines of a message
constexpr int kDeepest = 256;                       // maximum nesting depth of arrays and objects

/// Whether arrays and objects are nested deeper than kDeepest. The limit protects the stack, because the JSON library
/// copies and prints values recursively. For text that is not JSON, the result is arbitrary.
bool isTooDeep(std::string_view json) {
  int depth = 0;
  bool in_text = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text) {
      if (c == '\\') ++i;
      in_text = c != '"';
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepest) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

/// Reads messages in the Language Server Protocol's format: header lines, an empty line, then as many bytes as
/// Content-Length states.
class MessageReader {
 public:
  explicit MessageReader(std::istream& in) : in_(in) {}

  /// The bytes of the next message; an empty text if it is larger than kMaxBytes; nullopt at the end of the input.
  std::optional<std::string> next() {
    const std::optional<uint64_t> length = headers();
    if (!length) return std::nullopt;
    if (*length > kMaxBytes) {
      in_.ignore(static_cast<std::streamsize>(*length));
      return std::string();
    }
    std::string bytes(static_cast<size_t>(*length), '\0');
    in_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (static_cast<uint64_t>(in_.gcount()) != *length) return std::nullopt;
    return bytes;
  }
  /// Whether the input contained malformed or too long headers, after which the start of the next message cannot be
  /// found.
  bool lost() const { return lost_; }

 private:
  std::optional<uint64_t> headers() {
    constexpr std::string_view kLength = "content-length:";
    std::optional<uint64_t> length;
    std::string line;
    bool any = false;
    size_t left = kMaxHeaderBytes;
    while (headerLine(line, left)) {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (line.empty()) {
        lost_ = !length;
        return length;
      }
      any = true;
      std::string name = line.substr(0, kLength.size());
      std::transform(name.begin(), name.end(), name.begin(),
                     [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
      if (name != kLength) continue;
      const size_t digits = std::min(line.find_first_not_of(' ', kLength.size()), line.size());
      uint64_t value = 0;
      const auto [end, error] = std::from_chars(line.data() + digits, line.data() + line.size(), value);
      constexpr auto kLongest = static_cast<uint64_t>(std::numeric_limits<std::streamsize>::max());
      if (error == std::errc() && end == line.data() + line.size() && value < kLongest) length = value;
    }
    lost_ = any || left == 0;
    return std::nullopt;
  }

  /// Reads one header line. left: number of header bytes that may still be read; updated. Returns false at the end of
  /// the input, or if the line is longer than `left`.
  bool headerLine(std::string& line, size_t& left) {
    line.clear();
    for (char c = 0; left > 0 && in_.get(c); --left) {
      if (c == '\n') return true;
      line += c;
    }
    return left > 0 && !line.empty();
  }

  std::istream& in_;
  bool lost_ = false;
};

bool send(const nlohmann::json& message) {
  // Replace invalid UTF-8, because the text of an editor may contain it.
  const std::string bytes = message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  fmt::print("Content-Length: {}\r\n\r\n{}", bytes.size(), bytes);
  return std::fflush(stdout) == 0;
}

}  // namespace

Exit serveLanguage() {
  MessageReader reader(std::cin);
  LanguageServer server;
  while (!server.ended()) {
    const std::optional<std::string> bytes = reader.next();
    if (!bytes) break;
    const bool too_deep = isTooDeep(*bytes);
    const nlohmann::json message =
        too_deep ? nlohmann::json(nlohmann::json::value_t::discarded) : nlohmann::json::parse(*bytes, nullptr, false);
    if (message.is_discarded()) {
      const std::string why = bytes->empty() ? fmt::format("a message must have 1 to {} bytes", kMaxBytes)
                              : too_deep     ? fmt::format("arrays and objects may be nested at most {} deep", kDeepest)
                                             : "this is not JSON";
      if (!send(LanguageServer::answerToGarbage(why))) return Exit::file;
      continue;
    }
    for (const nlohmann::json& answer : server.handle(message))
      if (!send(answer)) return Exit::file;
  }
  if (reader.lost()) return reportError(Exit::input, "lsp: the input is not a message of the Language Server Protocol");
  return server.endedWell() ? Exit::done : Exit::input;
}

}  // namespace sgm::cli
