// `sgm fmt`: formats grammars in the canonical layout.

#include <fmt/core.h>

#include <algorithm>

#include "base/file_writer.h"
#include "tools/cli/grammar/commands.h"
#include "tools/support/console.h"
#include "tools/support/ending_signals.h"
#include "tools/support/source.h"

namespace sgm::cli {
namespace {

Exit formatOne(const std::string& file, const FmtOptions& options) {
  const Result<std::string> text = readGrammarText(file);
  if (!text) return reportError(text.error());
  const FormatResult formatted = formatGrammar(*text, file);
  for (const Diagnostic& d : formatted.diagnostics) fmt::print(stderr, "{}", renderDiagnostic(d, *text));
  if (!formatted.text) return Exit::input;
  if (options.check) {
    if (*formatted.text == *text) return Exit::done;
    return reportError(Exit::input, fmt::format("{} is not in canonical layout: run sgm fmt --write {}", file, file));
  }
  if (!options.write) {
    fmt::print("{}", *formatted.text);
    return Exit::done;
  }
  if (*formatted.text == *text) return Exit::done;
  Result<FileWriter> out = FileWriter::create(file, &unfinished_files);
  if (!out) return reportError(out.error());
  out->write(*formatted.text);
  if (Result<void> ok = out->commit(); !ok) return reportError(ok.error());
  fmt::print(stderr, "formatted {}\n", file);
  return Exit::done;
}

}  // namespace

Exit format(const FmtOptions& options) {
  Exit status = Exit::done;
  for (const std::string& file : options.files) status = std::max(status, formatOne(file, options));
  return status;
}

}  // namespace sgm::cli
