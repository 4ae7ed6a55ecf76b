#pragma once
// A file that a client uploads. It is written to disk as it arrives, so it needs no memory, and it disappears when the
// process ends in any way.

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
/// The kind's name: "glb", "obj", "ply", "stl", "sgm".
std::string_view nameOf(UploadKind kind);
/// The kind of an upload from its content type, or if that is application/octet-stream or empty, from the ending of its
/// file name. nullopt if unknown.
std::optional<UploadKind> uploadKind(std::string_view content_type, std::string_view name);

/// A file without a name in a folder; the system deletes it when its last descriptor is closed. Move-only.
class Upload {
 public:
  /// folder: if empty, the system's folder for temporary files. Error: io.
  static Result<Upload> create(const std::string& folder);
  /// Error: io (the disk is full).
  Result<void> append(std::string_view piece);
  int file() const { return file_.number(); }  ///< open for reading and writing
  uint64_t bytes() const { return bytes_; }

  std::string name;  ///< file name that the client sent, for display
  UploadKind kind = UploadKind::glb;
  /// For a grammar: the values of "region", "cell", "seed" and "set" as the client sent them.
  std::vector<std::pair<std::string, std::string>> options;

 private:
  explicit Upload(platform::File file) : file_(std::move(file)) {}

  platform::File file_;
  uint64_t bytes_ = 0;
};

}  // namespace sgm::service
