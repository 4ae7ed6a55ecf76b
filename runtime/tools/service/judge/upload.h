#pragma once
// A file that a client uploads, written to disk as it arrives. It has no name, so the system deletes it when the
// process ends, even after a crash.

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
/// Name of an upload's kind: "glb", "obj", "ply", "stl" or "sgm".
std::string_view nameOf(UploadKind kind);
/// The kind of an upload. The content type determines it or, if the content type is empty or application/octet-stream,
/// the extension of the file name. nullopt if the kind is unknown.
std::optional<UploadKind> uploadKind(std::string_view content_type, std::string_view name);

/// A file without a name; the system deletes it when its last descriptor is closed. Move-only.
class Upload {
 public:
  /// folder: directory of the file; if empty, the system's directory for temporary files. Error: io.
  static Result<Upload> create(const std::string& folder);
  /// Appends bytes to the file. Error: io if the disk is full.
  Result<void> append(std::string_view piece);
  int file() const { return file_.number(); }  ///< File descriptor, open for reading and writing.
  uint64_t bytes() const { return bytes_; }

  std::string name;  ///< name of the file as the client sent it, for display
  UploadKind kind = UploadKind::glb;
  /// Query parameters "region", "cell", "seed" and "set" of a grammar, as the client sent them.
  std::vector<std::pair<std::string, std::string>> options;

 private:
  explicit Upload(platform::File file) : file_(std::move(file)) {}

  platform::File file_;
  uint64_t bytes_ = 0;
};

}  // namespace sgm::service
