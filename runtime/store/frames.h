#pragma once
// Compression, ids and checksums of contents: all code that needs zstd and xxHash.

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

/// unsupported: this build has neither (SGM_DISK_CACHE=OFF); then no function below may be called.
Result<void> available();

/// xxHash128.
ContentId idOf(std::span<const std::byte> bytes);
/// A 64-bit checksum that detects damage.
uint64_t checksumOf(std::span<const std::byte> bytes);

/// Compresses to one zstd frame. It is made once for many readers, so it may take long. The same zstd gives the same
/// bytes on every machine. out_of_memory. Throws std::bad_alloc.
Result<std::pmr::vector<std::byte>> pack(std::span<const std::byte> content, std::pmr::memory_resource* memory);
/// Decompresses a frame; nullopt unless it is whole and holds exactly this many bytes. Accepts any bytes. Throws
/// std::bad_alloc.
std::optional<std::pmr::vector<std::byte>> unpack(std::span<const std::byte> frame, size_t content_bytes,
                                                  std::pmr::memory_resource* memory);

/// Decompresses repeatedly: reuses zstd's context, whose creation takes as long as most frames do. Contexts come from
/// the C heap, about 100 KB for each concurrent thread. Thread-safe.
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

/// 32 hexadecimal digits.
std::string nameOf(const ContentId& id);
void putId(const ContentId& id, ByteWriter& out);
ContentId getId(ByteReader& in);

}  // namespace sgm::store
