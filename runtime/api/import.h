#pragma once
// Sources of imported texts: the caller's callback, or else a folder on disk. No import can read files outside of the
// folder.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/compile.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// Reads imports from regular files in one folder. Rejects links that lead out of it.
class FolderImports final : public ImportResolver {
 public:
  explicit FolderImports(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Result<std::string> read(std::string_view path, size_t limit) override;

 private:
  std::filesystem::path folder_;
};

/// The imports of the C interface: asks the callback first (may be null), then the folder (may be null).
class CallerImports final : public ImportResolver {
 public:
  CallerImports(sgm_import_function function, void* user, const char* folder);
  Result<std::string> read(std::string_view path, size_t limit) override;

 private:
  sgm_import_function function_;
  void* user_;
  std::optional<FolderImports> folder_;
};

/// Returns a line of the file with this name, without its line end; "" if it does not exist. line: from 1.
std::string sourceLine(const std::vector<SourceFile>& files, std::string_view file, int line);

}  // namespace sgm::api
