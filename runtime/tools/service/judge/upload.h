#pragma once
// A file that a client sends, written to disk as it arrives: it needs no memory, and disappears when the process ends
// in any way.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/platform/file.h"
#include "base/result.h"

namespace sgm::service {

enum class UploadKind { glb, obj, ply, stl, grammar };
/// "glb", "obj", "ply", "stl", "sgm".
std::string_view nameOf(UploadKind kind);
/// From the content type, or if that is application/octet-stream or empty, from the name's ending. nullopt if unknown.
std::optional<UploadKind> uploadKind(std::string_view content_type, std::string_view name);

/// An unnamed file in a folder, which the system deletes when its last descriptor is closed. Move-only.
class Upload {
 public:
  /// folder: empty: the system's folder for temporary files. Error: io.
  static Result<Upload> create(const std::string& folder);
  /// Error: io (the disk is full).
  Result<void> append(std::string_view piece);
  int file() const { return file_.number(); }  ///< open for reading and writing
  uint64_t bytes() const { return bytes_; }

  std::string name;  ///< the client's; for display
  UploadKind kind = UploadKind::glb;
  /// For a grammar: "region", "cell", "seed", "set" with their values, as received.
  std::vector<std::pair<std::string, std::string>> options;

 private:
  explicit Upload(platform::File file) : file_(std::move(file)) {}

  platform::File file_;
  uint64_t bytes_ = 0;
};

}  // namespace sgm::service
