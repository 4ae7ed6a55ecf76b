#pragma once
// One entry of the disk cache as the bytes of its file.
//
// All numbers are little-endian: "SGMC", version (4 bytes each), key (16), size of the content, size of the payload,
// xxHash64 of the payload (8 each), payload: the content packed by zstd. Reading compares every field with something,
// so that no damage passes.

#include "store/cache/disk_cache.h"

namespace sgm {

inline constexpr uint32_t kDiskEntryVersion = 1;
/// No entry's file is larger: a content that zstd cannot pack grows by less than 1 in 128.
inline constexpr size_t kMaxDiskEntry = kMaxDiskContent + kMaxDiskContent / 128;

/// xxHash128.
DiskKey hashDiskKey(std::span<const std::byte> inputs);

/// The file's bytes; none where the content is larger than kMaxDiskContent or zstd gets no memory.
/// Throws std::bad_alloc.
std::optional<std::pmr::vector<std::byte>> packDiskEntry(const DiskKey& key, std::span<const std::byte> content,
                                                         std::pmr::memory_resource* memory);

/// The content; none unless the bytes are those of an entry of this version and key, whole and undamaged. For any
/// bytes; takes memory for no more than kMaxDiskContent. Throws std::bad_alloc.
std::optional<std::pmr::vector<std::byte>> unpackDiskEntry(const DiskKey& key, std::span<const std::byte> file,
                                                           std::pmr::memory_resource* memory);

}  // namespace sgm
