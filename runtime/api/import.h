#pragma once
// Sources of imported grammar files: the caller's callback, and a folder on disk. Imports cannot read files outside the
// folder.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/compile.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// Reads imports from regular files in one folder. Rejects symbolic links that lead out of it.
class FolderImports final : public ImportResolver {
 public:
  explicit FolderImports(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Result<std::string> read(std::string_view path, size_t limit) override;

 private:
  std::filesystem::path folder_;
};

/// Resolves the imports of a grammar that is compiled through the C interface: asks the callback first, then the
/// folder. Either may be null.
class CallerImports final : public ImportResolver {
 public:
  CallerImports(sgm_import_function function, void* user, const char* folder);
  Result<std::string> read(std::string_view path, size_t limit) override;

 private:
  sgm_import_function function_;
  void* user_;
  std::optional<FolderImports> folder_;
};

/// Returns a line of a source file without its line end; "" if the file or the line does not exist. file: the file's
/// name; line: counted from 1.
std::string sourceLine(const std::vector<SourceFile>& files, std::string_view file, int line);

}  // namespace sgm::api
