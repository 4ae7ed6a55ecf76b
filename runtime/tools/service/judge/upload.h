#pragma once
// A file that a client sends, written to disk as it comes: nothing of it is held in memory, and nothing of it is left
// behind, whatever ends the process.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"

namespace sgm::service {

enum class UploadKind { glb, obj, ply, stl, grammar };
/// "glb", "obj", "ply", "stl", "sgm".
std::string_view nameOf(UploadKind kind);
/// By a content type, or where that is application/octet-stream or empty, by what the name ends in. Nothing: neither.
std::optional<UploadKind> uploadKind(std::string_view content_type, std::string_view name);

/// A file without a name in a folder: it is gone when the last who has it open closes it. Moves only.
class Upload {
 public:
  /// folder: empty for the machine's own one for temporary files. Error: io.
  static Result<Upload> create(const std::string& folder);
  Upload(Upload&& other) noexcept;
  Upload& operator=(Upload&& other) noexcept;
  ~Upload();

  /// Error: io (the disk is full).
  Result<void> append(std::string_view piece);
  int file() const { return file_; }  ///< open for reading and writing
  uint64_t bytes() const { return bytes_; }

  std::string name;  ///< the client's; for people
  UploadKind kind = UploadKind::glb;
  /// Of a grammar: "region", "cell", "seed", "set" with their values, as they came.
  std::vector<std::pair<std::string, std::string>> options;

 private:
  explicit Upload(int file) : file_(file) {}

  int file_ = -1;
  uint64_t bytes_ = 0;
};

}  // namespace sgm::service
