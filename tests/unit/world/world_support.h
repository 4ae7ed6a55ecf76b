#pragma once
// Worlds of the sample grammars, and their meshes.

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "backend/open/open_backend.h"
#include "catch.h"
#include "chunk/mesh_chunks.h"
#include "grammar/compile.h"

namespace sgm {

inline std::string textOfFile(const std::string& path) {
  std::ifstream file(path);
  REQUIRE(file);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

inline std::string sample(const std::string& name) { return textOfFile(std::string(SGM_SAMPLE_GRAMMARS) + "/" + name); }

/// The text of a grammar in tests/bench/grammars, which are copies that do not change with the samples: for tests that
/// depend on certain positions and numbers.
inline std::string yardstick(const std::string& name) {
  return textOfFile(std::string(SGM_BENCH_GRAMMARS) + "/" + name);
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// The text of the cave without its stalactites (the layer `drip`), because their many small grammar cells would make
/// the tests slow.
inline std::string caveText() {
  return replaced(yardstick("cave.sgm"), "layer drip cell 24m reach 5m uses net { start Drips; }", "");
}

inline WorldFieldSettings settingsOf(const std::string& text, int32_t cell, uint64_t seed = 7) {
  const CompileResult compiled = compileGrammar(text, "test.sgm");
  INFO(renderDiagnostics(compiled));
  REQUIRE(compiled.program);
  WorldFieldSettings s;
  s.program = compiled.program;
  s.parameters = ParameterValues::defaults(*compiled.program);
  s.seed = seed;
  s.finest_cell = cell;
  return s;
}

inline uint32_t ruleNamed(const Program& program, std::string_view name) {
  for (uint32_t r = 0; r < program.rules.size(); ++r) {
    if (program.text(program.rules[r].name) == name) return r;
  }
  FAIL("no such rule");
  return 0;
}

inline std::pmr::vector<PlacedChunk> meshAll(const WorldField& world, const std::vector<ChunkRequest>& requests,
                                             unsigned threads, const EditSnapshot* edits = nullptr) {
  const auto jobs = *makeThreadPool(threads);
  Result<std::unique_ptr<Backend>> backend = makeBackend({}, *jobs, world.memory());
  REQUIRE(backend);
  Result<std::pmr::vector<PlacedChunk>> chunks = meshChunks(world, **backend, *jobs, requests, {}, edits);
  INFO((chunks ? "" : chunks.error().message));
  REQUIRE(chunks);
  return std::move(*chunks);
}

}  // namespace sgm
