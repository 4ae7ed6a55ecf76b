#pragma once
// A file that is there whole or not at all.

#include <filesystem>
#include <string_view>

#include "base/result.h"

namespace sgm::cli {

/// Written beside its place and renamed into it by commit(); without that, nothing is left behind. What already stands
/// there and is no regular file (a device, a pipe) is written to directly instead, for it must not be replaced.
class OutputFile {
 public:
  /// Error: io, with the path and the reason.
  static Result<OutputFile> open(const std::filesystem::path& path);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  /// All of it, or an error. Error: io.
  Result<void> write(std::string_view bytes);
  /// Puts the file in its place, down to the disk. Once. Error: io.
  Result<void> commit();

 private:
  OutputFile(std::filesystem::path path, std::filesystem::path part, int descriptor)
      : path_(std::move(path)), part_(std::move(part)), descriptor_(descriptor) {}
  Error failure(int number) const;

  std::filesystem::path path_;
  std::filesystem::path part_;  ///< empty where the path is written to directly
  int descriptor_;
};

}  // namespace sgm::cli
