#include "tools/support/source.h"

#include <fmt/core.h>

#include <filesystem>

#include "api/import.h"
#include "base/file_reader.h"

namespace sgm::cli {
namespace {

/// Reads a grammar file and passes its text to `make`, a function of the compiler. Imports are read from the file's
/// directory.
template <class Made>
Result<Made> readAnd(Made (*make)(std::string_view, std::string_view, const CompileOptions&), const std::string& file) {
  Result<std::string> text = readGrammarText(file);
  if (!text) return text.error();
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  api::FolderImports imports(folder.empty() ? std::filesystem::path(".") : folder);
  CompileOptions options;
  options.resolver = &imports;
  return make(*text, file, options);
}

}  // namespace

Result<std::string> readGrammarText(const std::string& file) {
  return readFile(file, CompileLimits{}.text_bytes, Readable::all_but_folders);
}

Result<CompileResult> compileFile(const std::string& file) { return readAnd(compileGrammar, file); }

Result<CheckResult> checkFileOnDisk(const std::string& file) { return readAnd(checkFile, file); }

LoadedGrammar loadGrammar(const std::string& file) {
  const Result<CompileResult> compiled = [&] {
    const ProgressBar bar("compiling");
    return compileFile(file);
  }();
  if (!compiled) return {nullptr, reportError(compiled.error())};
  fmt::print(stderr, "{}", renderDiagnostics(*compiled));
  return {compiled->program, compiled->program ? Exit::done : Exit::input};
}

}  // namespace sgm::cli
