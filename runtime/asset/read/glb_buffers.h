#pragma once
// The bytes of a glTF file's buffers, and the views into them.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asset/read/glb_container.h"
#include "base/json_reader.h"
#include "base/result.h"

namespace sgm::asset {

class GlbBuffers {
 public:
  /// Buffers are the file's binary part or `data:` URIs within its JSON; other files are not opened.
  GlbBuffers(const JsonValue& root, const GlbContainer& file);

  struct View {
    std::span<const std::byte> bytes;
    std::optional<size_t> stride;
    size_t buffer = 0;
  };

  size_t viewCount() const { return views_.size(); }
  /// Returns the total size of all buffers in bytes.
  size_t bytes() const { return bytes_; }
  /// Returns the bytes of a buffer view, which must exist. Error: bad_input if its bytes are missing.
  Result<View> view(size_t number) const;
  /// Returns the place of a byte for a message: "byte 12", or "byte 12 of buffer 1" if the buffer is not stored in the
  /// file unchanged.
  std::string placeOf(size_t buffer, const std::byte* at) const;

 private:
  /// A buffer view as the file declares it, unchecked.
  struct Said {
    std::optional<size_t> buffer;
    size_t offset = 0, length = 0;
    std::optional<size_t> stride;
    std::string compression;  ///< name of the extension that compresses the view; empty: not compressed
  };
  struct Buffer {
    std::span<const std::byte> bytes;
    std::optional<size_t> file_at;
    std::string problem;  ///< the reason why the buffer has no bytes; empty if it has
  };

  void addBuffer(const JsonValue& value, size_t number, const GlbContainer& file);

  std::vector<Said> views_;
  std::vector<Buffer> buffers_;
  std::vector<std::vector<std::byte>> decoded_;
  size_t bytes_ = 0;
};

}  // namespace sgm::asset
