// Compiles arbitrary text: the compiler must end within its limits without undefined behaviour. Printing the parsed
// text must keep its meaning, and printing the result again must not change it.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "grammar/compile.h"
#include "grammar/help/declarations.h"

namespace {

/// Resolves every import to the importing text itself, so that cycles and the limits on depth and number are reached.
class SameText : public sgm::ImportResolver {
 public:
  explicit SameText(std::string_view text) : text_(text) {}
  sgm::Result<std::string> read(std::string_view path, size_t limit) override {
    // No import path may leave the folder, whatever the text says.
    for (size_t from = 0; from <= path.size();) {
      const size_t end = std::min(path.find('/', from), path.size());
      const std::string_view part = path.substr(from, end - from);
      require(!part.empty() && part != "." && part != "..", "left the folder");
      from = end + 1;
    }
    require(!path.empty() && path.front() != '/', "an absolute path");
    if (text_.size() > limit) return sgm::Error{sgm::Code::limit, "too long"};
    return std::string(text_);
  }

  static void require(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "parser_fuzz: %s\n", what);
    std::abort();
  }

 private:
  std::string_view text_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  sgm::CompileOptions options;
  SameText resolver(text);
  options.resolver = &resolver;
  options.limits.files = 4;
  options.limits.bound_steps = 1u << 14;
  const sgm::CompileResult result = sgm::compileGrammar(text, "fuzz.sgm", options);
  bool error = false;
  for (const sgm::Diagnostic& d : result.diagnostics) {
    error = error || d.severity == sgm::Severity::error;
    SameText::require(d.line >= 1 && d.column >= 1 && d.end_column > d.column, "a diagnostic without a place");
  }
  SameText::require(error == (result.program == nullptr), "a program in spite of errors, or none without");
  sgm::renderDiagnostics(result);
  for (const sgm::DeclaredName& name : sgm::declarationsOf(text).names)
    SameText::require(name.at.end <= size && name.whole.end <= size && name.known.end <= size,
                      "a name beyond the text");
  for (size_t offset = 0; offset <= size; offset += 1 + size / 8)
    if (const auto word = sgm::wordAt(text, static_cast<uint32_t>(offset)))
      SameText::require(word->at.end <= size, "a word beyond the text");

  const sgm::FormatResult once = sgm::formatGrammar(text, "fuzz.sgm");
  if (!once.text) return 0;
  const sgm::FormatResult twice = sgm::formatGrammar(*once.text, "fuzz.sgm");
  SameText::require(twice.text.has_value(), "what was printed does not parse");
  SameText::require(*twice.text == *once.text, "printing is no fixed point");
  if (!result.program) return 0;
  const sgm::CompileResult again = sgm::compileGrammar(*once.text, "fuzz.sgm", options);
  // Compare only programs without imports: every import resolves to the original text, not the printed one.
  if (result.files.size() == 1)
    SameText::require(again.program && again.program->hash == result.program->hash, "printing changed the meaning");
  return 0;
}
