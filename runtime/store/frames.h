#pragma once
// Compression, ids and checksums of contents. All code of the store that needs zstd and xxHash is here.

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/result.h"
#include "store/cache/disk_cache.h"

namespace sgm::store {

/// A 128-bit hash that identifies bytes.
using ContentId = DiskKey;

/// Error: unsupported if this build has neither zstd nor xxHash (SGM_DISK_CACHE=OFF). Then no function below may be
/// called.
Result<void> available();

/// Returns the xxHash128 of the bytes.
ContentId idOf(std::span<const std::byte> bytes);
/// Returns a 64-bit checksum, to detect damage.
uint64_t checksumOf(std::span<const std::byte> bytes);

/// Compresses the content to one zstd frame. It may take long, because a frame is made once for many readers. The same
/// version of zstd gives the same bytes on every machine. Error: out_of_memory. Throws std::bad_alloc.
Result<std::pmr::vector<std::byte>> pack(std::span<const std::byte> content, std::pmr::memory_resource* memory);
/// Decompresses a frame; nullopt unless it is complete and contains exactly this many bytes. Accepts any bytes. Throws
/// std::bad_alloc.
std::optional<std::pmr::vector<std::byte>> unpack(std::span<const std::byte> frame, size_t content_bytes,
                                                  std::pmr::memory_resource* memory);

/// Decompresses many frames. Reuses zstd's contexts, because creating one takes as long as decompressing most frames.
/// Contexts are allocated from the C heap, about 100 KB per concurrent thread. Thread-safe.
class Unpacker {
 public:
  Unpacker() = default;
  ~Unpacker();
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;
  std::optional<std::pmr::vector<std::byte>> unpack(std::span<const std::byte> frame, size_t content_bytes,
                                                    std::pmr::memory_resource* memory);

 private:
  std::mutex mutex_;
  std::vector<void*> idle_;
  size_t made_ = 0;
};

/// Computes idOf of bytes that arrive in pieces.
class IdStream {
 public:
  /// Throws std::bad_alloc.
  IdStream();
  ~IdStream();
  IdStream(const IdStream&) = delete;
  IdStream& operator=(const IdStream&) = delete;
  void add(std::span<const std::byte> bytes);
  ContentId id() const;

 private:
  void* state_;
};

/// Formats an id as 32 hexadecimal digits.
std::string nameOf(const ContentId& id);
void putId(const ContentId& id, ByteWriter& out);
ContentId getId(ByteReader& in);

}  // namespace sgm::store
