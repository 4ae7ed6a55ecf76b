#pragma once
// The file format of an entry of the disk cache. All numbers are little-endian:
// "SGMC", version (4 bytes each); key (16 bytes); size of the content, size of the payload, xxHash64 of the payload (8
// bytes each); payload: the content compressed by zstd.
// A reader checks every field, so that all damage is detected.

#include "store/cache/disk_cache.h"

namespace sgm {

inline constexpr uint32_t kDiskEntryVersion = 1;
/// The maximum size of an entry's file in bytes: zstd enlarges incompressible content by less than 1/128.
inline constexpr size_t kMaxDiskEntry = kMaxDiskContent + kMaxDiskContent / 128;

/// Returns the xxHash128 of the bytes.
DiskKey hashDiskKey(std::span<const std::byte> inputs);

/// Returns the bytes of an entry's file; nullopt if the content is larger than kMaxDiskContent, or zstd runs out of
/// memory. Throws std::bad_alloc.
std::optional<std::pmr::vector<std::byte>> packDiskEntry(const DiskKey& key, std::span<const std::byte> content,
                                                         std::pmr::memory_resource* memory);

/// Returns the content of an entry's file; nullopt unless the bytes are a complete, undamaged entry of this format
/// version and this key. Accepts arbitrary bytes; allocates at most kMaxDiskContent bytes. Throws std::bad_alloc.
std::optional<std::pmr::vector<std::byte>> unpackDiskEntry(const DiskKey& key, std::span<const std::byte> file,
                                                           std::pmr::memory_resource* memory);

}  // namespace sgm
