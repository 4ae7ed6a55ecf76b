#pragma once
// Parses texts without checking them, so that names stay as they were written.

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "catch.h"
#include "grammar/parse/parse_module.h"
#include "random_program.h"

namespace sgm::test {

struct Parsed {
  std::unique_ptr<Program> program;
  ModuleSyntax syntax;
};

/// Parses a text. The program is null if the text has errors.
inline Parsed parsed(std::string_view text) {
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
  Parsed result;
  result.program = std::make_unique<Program>(memory);
  result.program->modules.emplace_back(memory).text = text;
  NameTable names(result.program->ast);
  const CompileLimits limits;
  DiagnosticSink sink(limits.diagnostics);
  sink.addFile("test.sgm");
  result.syntax = parseModule(*result.program, names, 0, limits, sink);
  if (sink.errorCount() > 0) result.program.reset();
  return result;
}

/// The texts of all grammars in the repository that parse, and of some random programs.
inline const std::vector<std::string>& grammarTexts() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> texts;
    for (const char* folder : {"/samples", "/runtime/grammar/std", "/runtime/tools/paper/grammars",
                               "/tests/bench/grammars", "/editor_plugin/demo/grammars"}) {
      for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(SGM_SOURCE_DIR) + folder)) {
        if (entry.path().extension() != ".sgm") continue;
        std::ifstream file(entry.path(), std::ios::binary);
        std::stringstream bytes;
        bytes << file.rdbuf();
        texts.push_back(bytes.str());
      }
    }
    REQUIRE(texts.size() > 80);
    for (uint64_t seed = 1; seed <= 100; ++seed) texts.push_back(randomProgram(seed));
    return texts;
  }();
  return all;
}

}  // namespace sgm::test
