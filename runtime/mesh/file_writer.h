#pragma once
// Output files that appear whole or not at all.

#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sgm {

/// Writes to a temporary file beside the target and renames it on commit. Whatever fails, and without commit, the
/// destructor leaves nothing behind and the target as it was. The first error is kept and comes out of commit. One
/// thread.
class FileWriter {
 public:
  /// Error: Code::io, where the folder is missing or not writable, or the target is a folder.
  static Result<FileWriter> create(const std::filesystem::path& target);

  FileWriter(FileWriter&& other) noexcept;
  FileWriter& operator=(FileWriter&&) = delete;
  ~FileWriter();

  void write(const void* bytes, size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Little-endian on every machine we build for; T is an arithmetic type.
  template <class T>
  void writeValue(T value) {
    write(&value, sizeof value);
  }

  /// Everything handed to the disk, under the temporary name still. Error: Code::io, for instance when the disk is
  /// full.
  Result<void> finish();
  /// finish, then the rename.
  Result<void> commit();

 private:
  FileWriter(std::filesystem::path target, std::filesystem::path temporary, std::FILE* file);
  void flush();
  Error errorFrom(int code) const;

  std::filesystem::path target_, temporary_;
  std::FILE* file_ = nullptr;
  std::vector<char> buffer_;
  int first_error_ = 0;  // errno of the first failure
  bool exists_ = false;  // the temporary file
};

}  // namespace sgm
