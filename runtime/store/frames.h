#pragma once
// Contents as the bytes of files, and what they are known by: all that needs zstd and xxHash.

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

/// 128 bits that stand for bytes.
using ContentId = DiskKey;

/// unsupported: this build has neither (SGM_DISK_CACHE=OFF); then nothing below may be called.
Result<void> available();

/// xxHash128.
ContentId idOf(std::span<const std::byte> bytes);
/// 64 bits that tell damage.
uint64_t checksumOf(std::span<const std::byte> bytes);

/// One zstd frame, for any number of readers to come: made once, it may take its time. The same bytes on every machine
/// that has the same zstd. out_of_memory. Throws std::bad_alloc.
Result<std::pmr::vector<std::byte>> pack(std::span<const std::byte> content, std::pmr::memory_resource* memory);
/// The content; none unless the frame is whole and holds just so many bytes. For any bytes. Throws std::bad_alloc.
std::optional<std::pmr::vector<std::byte>> unpack(std::span<const std::byte> frame, size_t content_bytes,
                                                  std::pmr::memory_resource* memory);

/// unpack, again and again: keeps what zstd works with, whose making takes as long as most frames do. It comes from the
/// C heap, some 100 KB for each thread that has been here at one time. Any thread.
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

/// idOf bytes that come one part after the other.
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
