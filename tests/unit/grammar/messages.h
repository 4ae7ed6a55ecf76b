#pragma once
// What the compiler says of a text, in words: for tests that hold every message to the letter.

#include <span>
#include <string>

#include "catch.h"
#include "compile_text.h"

namespace sgm::test {

/// All diagnostics: "3:17 unit-mismatch: message | hint | note: note", a line each; warnings say so.
inline std::string inWords(const CompileResult& result) {
  std::string out;
  for (const Diagnostic& d : result.diagnostics) {
    if (!out.empty()) out += '\n';
    out.append(std::to_string(d.line)).append(":").append(std::to_string(d.column)).append(" ");
    out.append(d.severity == Severity::warning ? "warning " : "").append(d.code).append(": ").append(d.message);
    if (!d.hint.empty()) out.append(" | ").append(d.hint);
    for (const std::string& note : d.notes) out.append(" | note: ").append(note);
  }
  return out;
}

/// Whether a message says what to write instead: what it expected, or a hint.
inline bool saysWhatToWrite(const Diagnostic& d) { return !d.hint.empty() || d.message.starts_with("expected "); }

struct MessageCase {
  const char* expected;  ///< as inWords() has it
  const char* text;
};

/// What stands around the text of each case.
struct Around {
  std::string before, after;
};

inline void checkMessages(std::span<const MessageCase> cases, const Around& around = {}) {
  for (const MessageCase& c : cases) {
    const CompileResult result = compileText(around.before + c.text + around.after);
    INFO(renderDiagnostics(result));
    CHECK(inWords(result) == c.expected);
    for (const Diagnostic& d : result.diagnostics) {
      CHECK(saysWhatToWrite(d));
      CHECK(d.end_column > d.column);
    }
  }
}

}  // namespace sgm::test
