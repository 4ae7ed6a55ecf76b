#pragma once
// Compression, hashes and checksums of stored content. All code of the store that needs zstd and xxHash is here.

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

/// Error: unsupported if this build has neither zstd nor xxHash (SGM_DISK_CACHE=OFF). In that case, no other function
/// of this file may be called.
Result<void> available();

/// Returns the xxHash128 of the bytes.
ContentId idOf(std::span<const std::byte> bytes);
/// Returns a 64-bit checksum, to detect damage.
uint64_t checksumOf(std::span<const std::byte> bytes);

/// Compresses the content into one zstd frame, at a high and therefore slow level, because a frame is written once and
/// read often. The same version of zstd gives the same bytes on every machine. Error: out_of_memory. Throws
/// std::bad_alloc.
Result<std::pmr::vector<std::byte>> pack(std::span<const std::byte> content, std::pmr::memory_resource* memory);
/// Decompresses a frame; nullopt unless it is complete and contains exactly content_bytes bytes. Accepts arbitrary
/// bytes. Throws std::bad_alloc.
std::optional<std::pmr::vector<std::byte>> unpack(std::span<const std::byte> frame, size_t content_bytes,
                                                  std::pmr::memory_resource* memory);

/// Decompresses frames. Reuses zstd's contexts, because creating a context takes as long as decompressing most frames.
/// Each concurrent thread needs one context, which allocates about 100 KB from the C heap. Thread-safe.
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

/// Computes the hash (idOf) of bytes that arrive in pieces.
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

/// Formats a hash as 32 hexadecimal digits.
std::string nameOf(const ContentId& id);
void putId(const ContentId& id, ByteWriter& out);
ContentId getId(ByteReader& in);

}  // namespace sgm::store
