#pragma once
// The file format of a disk cache entry.
//
// All numbers are little-endian: "SGMC", version (4 bytes each), key (16), size of the content, size of the payload,
// xxHash64 of the payload (8 each), payload: the content compressed by zstd. Reading checks every field, so that no
// damage goes unnoticed.

#include "store/cache/disk_cache.h"

namespace sgm {

inline constexpr uint32_t kDiskEntryVersion = 1;
/// The largest file of an entry: incompressible content grows by less than 1 in 128 with zstd.
inline constexpr size_t kMaxDiskEntry = kMaxDiskContent + kMaxDiskContent / 128;

/// xxHash128.
DiskKey hashDiskKey(std::span<const std::byte> inputs);

/// The file's bytes; nullopt if the content is larger than kMaxDiskContent or zstd runs out of memory. Throws
/// std::bad_alloc.
std::optional<std::pmr::vector<std::byte>> packDiskEntry(const DiskKey& key, std::span<const std::byte> content,
                                                         std::pmr::memory_resource* memory);

/// The content; nullopt unless the bytes are a whole, undamaged entry of this version and key. Accepts any bytes;
/// allocates at most kMaxDiskContent. Throws std::bad_alloc.
std::optional<std::pmr::vector<std::byte>> unpackDiskEntry(const DiskKey& key, std::span<const std::byte> file,
                                                           std::pmr::memory_resource* memory);

}  // namespace sgm
