#pragma once
// The buffers and buffer views of a glTF file.

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
  /// Accepts buffers in the file's binary chunk or in `data:` URIs in its JSON; other files are not opened.
  GlbBuffers(const JsonValue& root, const GlbContainer& file);

  struct View {
    std::span<const std::byte> bytes;
    std::optional<size_t> stride;
    size_t buffer = 0;
  };

  size_t viewCount() const { return views_.size(); }
  /// Returns the total size of all buffers in bytes.
  size_t bytes() const { return bytes_; }
  /// Returns the bytes of a buffer view, which must exist. Error: bad_input if the buffer does not contain these bytes.
  Result<View> view(size_t number) const;
  /// Describes the position of a byte for a message: "byte 12" of the file, or "byte 12 of buffer 1" if the buffer's
  /// bytes are not in the file as they are (base64).
  std::string placeOf(size_t buffer, const std::byte* at) const;

 private:
  /// A buffer view as the file declares it, not yet checked.
  struct Said {
    std::optional<size_t> buffer;
    size_t offset = 0, length = 0;
    std::optional<size_t> stride;
    std::string compression;  ///< name of the extension that compresses the view; empty if it is not compressed
  };
  struct Buffer {
    std::span<const std::byte> bytes;
    std::optional<size_t> file_at;
    std::string problem;  ///< the reason why the bytes of the buffer are unavailable; empty if they are available
  };

  void addBuffer(const JsonValue& value, size_t number, const GlbContainer& file);

  std::vector<Said> views_;
  std::vector<Buffer> buffers_;
  std::vector<std::vector<std::byte>> decoded_;
  size_t bytes_ = 0;
};

}  // namespace sgm::asset
