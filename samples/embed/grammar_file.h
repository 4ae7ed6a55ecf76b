#pragma once
// Compiles a grammar from a file.

#include <sgm/sgm.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "handles.h"

/// Compiles the grammar in a file. Its imports are read from the folder of the file.
inline GrammarOwner compileFile(sgm_runtime* runtime, const char* path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || !std::filesystem::is_regular_file(path)) throw std::runtime_error(std::string("cannot read ") + path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string folder = std::filesystem::path(path).parent_path().string();
  sgm_grammar_desc desc = SGM_GRAMMAR_DESC_INIT;
  desc.text = text.data();
  desc.text_size = text.size();
  desc.name = path;
  desc.import_folder = folder.empty() ? "." : folder.c_str();
  sgm_grammar* grammar = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  must(sgm_grammar_compile(runtime, &desc, &grammar, nullptr, &error), error);
  return GrammarOwner(grammar);
}
