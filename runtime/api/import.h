#pragma once
// Sources of imported text: the caller's callback, then a folder on disk that no import may leave.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grammar/compile.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// Reads imports from regular files inside one folder. Links that lead out of it are refused.
class FolderImports final : public ImportResolver {
 public:
  explicit FolderImports(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Result<std::string> read(std::string_view path, size_t limit) override;

 private:
  std::filesystem::path folder_;
};

/// The C interface's imports: the callback (may be null) first, then the folder (may be null).
class CallerImports final : public ImportResolver {
 public:
  CallerImports(sgm_import_function function, void* user, const char* folder);
  Result<std::string> read(std::string_view path, size_t limit) override;

 private:
  sgm_import_function function_;
  void* user_;
  std::optional<FolderImports> folder_;
};

/// Reads a whole file of at most limit bytes. Errors: io (with the system's reason), limit.
Result<std::string> readTextFile(const std::filesystem::path& path, size_t limit);

/// One line (from 1) of the file with that name, without its line feed; "" if it does not exist.
std::string sourceLine(const std::vector<SourceFile>& files, std::string_view file, int line);

}  // namespace sgm::api
