// sgm fmt: the canonical layout of a grammar.

#include <fmt/core.h>

#include "cli/commands.h"
#include "cli/source.h"
#include "mesh/file_writer.h"

namespace sgm::cli {
namespace {

struct FmtOptions {
  std::vector<std::string> files;
  bool write = false;
  bool check = false;
};

Exit formatOne(const std::string& file, const FmtOptions& options) {
  const Result<std::string> text = readGrammarText(file);
  if (!text) return complain(text.error());
  const FormatResult formatted = formatGrammar(*text, file);
  for (const Diagnostic& d : formatted.diagnostics) fmt::print(stderr, "{}", renderDiagnostic(d, *text));
  if (!formatted.text) return Exit::input;
  if (options.check) {
    if (*formatted.text == *text) return Exit::done;
    return complain(Exit::input, fmt::format("{} is not in canonical layout: run sgm fmt --write {}", file, file));
  }
  if (!options.write) {
    fmt::print("{}", *formatted.text);
    return Exit::done;
  }
  if (*formatted.text == *text) return Exit::done;
  Result<FileWriter> out = FileWriter::create(file);
  if (!out) return complain(out.error());
  out->write(*formatted.text);
  if (Result<void> ok = out->commit(); !ok) return complain(ok.error());
  fmt::print(stderr, "formatted {}\n", file);
  return Exit::done;
}

Exit format(const FmtOptions& options) {
  Exit status = Exit::done;
  for (const std::string& file : options.files) {
    if (const Exit one = formatOne(file, options); one != Exit::done) status = one;
  }
  return status;
}

}  // namespace

Command addFmt(CLI::App& root) {
  CLI::App* app = root.add_subcommand("fmt", "Print grammars in their canonical layout, or put them into it");
  const auto options = std::make_shared<FmtOptions>();
  app->add_option("FILE", options->files, "Grammars, .sgm files")->required();
  CLI::Option* write = app->add_flag("--write", options->write, "Change the files in place");
  app->add_flag("--check", options->check, "Change nothing; status 1 where a file is not in canonical layout")
      ->excludes(write);
  app->footer("Example:\n  sgm fmt --write samples/grammars/cave.sgm");
  return [options] { return format(*options); };
}

}  // namespace sgm::cli
