#include "grammar/text/diagnostics.h"

#include <algorithm>

#include "base/utf8.h"
#include "grammar/text/sink.h"

namespace sgm {

namespace {

/// Returns a line of the source, without its line end; empty if the line does not exist.
std::string_view lineOf(std::string_view source, int line) {
  for (int at = 1; at < line; ++at) {
    const size_t end = source.find('\n');
    if (end == std::string_view::npos) return {};
    source.remove_prefix(end + 1);
  }
  source = source.substr(0, source.find('\n'));
  if (source.ends_with('\r')) source.remove_suffix(1);
  return source;
}

bool isContinuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

}  // namespace

std::string renderDiagnostic(const Diagnostic& d, std::string_view source) {
  std::string out = d.file;
  if (d.line > 0) out += join({":", std::to_string(d.line), ":", std::to_string(d.column)});
  out += join({": ", d.severity == Severity::error ? "error" : "warning", ": ", d.message, "\n"});

  std::string_view line = d.line > 0 ? lineOf(source, d.line) : std::string_view();
  if (!line.empty()) {
    // Only a part of the line is shown, since an untrusted file may be one very long line.
    constexpr size_t kWindow = 160;
    const size_t column = static_cast<size_t>(d.column - 1);
    size_t first = column > kWindow / 2 && line.size() > kWindow ? column - kWindow / 2 : 0;
    while (first > 0 && first < line.size() && isContinuation(line[first])) --first;
    const size_t last = std::min(line.size(), first + kWindow);
    std::string shown, caret;
    size_t next = first;  // offset in the line of the next character to be shown
    for (size_t i = first; i < std::max(last, column + 1); ++i) {
      const char c = i < last ? line[i] : ' ';
      const size_t size = i < last ? utf8Size(line.substr(i)) : 1;
      const bool begins = i >= next;
      if (begins) next = i + std::max(size, size_t{1});
      // Replace control characters and invalid bytes, which must not reach the terminal; keep tabs, so that the caret
      // stays aligned.
      const bool hidden = (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F || (begins && size == 0);
      if (i < last) shown += hidden ? '?' : c;
      if (i < column && begins) caret += c == '\t' ? '\t' : ' ';
    }
    caret += '^';
    const size_t end = std::min(last, static_cast<size_t>(std::max(d.end_column - 1, d.column)));
    for (size_t i = column + 1; i < end; ++i)
      if (!isContinuation(line[i])) caret += '~';
    out += join({"  ", shown, "\n  ", caret, "\n"});
  }
  if (!d.hint.empty()) out += join({"  hint: ", d.hint, "\n"});
  for (const std::string& note : d.notes) out += join({"  note: ", note, "\n"});
  return out;
}

std::string countDiagnostics(const std::vector<Diagnostic>& diagnostics) {
  const auto errors = std::count_if(diagnostics.begin(), diagnostics.end(),
                                    [](const Diagnostic& d) { return d.severity == Severity::error; });
  const auto warnings = static_cast<std::ptrdiff_t>(diagnostics.size()) - errors;
  return join({std::to_string(errors), errors == 1 ? " error, " : " errors, ", std::to_string(warnings),
               warnings == 1 ? " warning" : " warnings"});
}

}  // namespace sgm
