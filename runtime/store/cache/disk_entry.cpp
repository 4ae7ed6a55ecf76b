#include "store/cache/disk_entry.h"

#include <zstd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <bit>
#include <cstring>

namespace sgm {
namespace {

static_assert(std::endian::native == std::endian::little, "entries have the byte order of memory");

struct EntryHeader {
  std::array<char, 4> magic{'S', 'G', 'M', 'C'};
  uint32_t version = kDiskEntryVersion;
  DiskKey key;
  uint64_t content_bytes = 0, payload_bytes = 0, payload_hash = 0;
  friend bool operator==(const EntryHeader&, const EntryHeader&) = default;
};
static_assert(sizeof(EntryHeader) == 48);

// At level 3, the compressed chunks of the sample grammar `cave` would be half a percent smaller than at level 1, but
// storing them would take a quarter longer.
constexpr int kZstdLevel = 1;

}  // namespace

DiskKey hashDiskKey(std::span<const std::byte> inputs) {
  const XXH128_hash_t hash = XXH3_128bits(inputs.data(), inputs.size());
  return {hash.high64, hash.low64};
}

std::optional<std::pmr::vector<std::byte>> packDiskEntry(const DiskKey& key, std::span<const std::byte> content,
                                                         std::pmr::memory_resource* memory) {
  if (content.size() > kMaxDiskContent) return std::nullopt;
  const size_t room = ZSTD_compressBound(content.size());
  std::pmr::vector<std::byte> file(sizeof(EntryHeader) + room, memory);
  std::byte* payload = file.data() + sizeof(EntryHeader);
  EntryHeader header;
  header.key = key;
  header.content_bytes = content.size();
  header.payload_bytes = ZSTD_compress(payload, room, content.data(), content.size(), kZstdLevel);
  if (ZSTD_isError(header.payload_bytes)) return std::nullopt;
  header.payload_hash = XXH64(payload, header.payload_bytes, 0);
  std::memcpy(file.data(), &header, sizeof header);
  file.resize(sizeof header + header.payload_bytes);
  return file;
}

std::optional<std::pmr::vector<std::byte>> unpackDiskEntry(const DiskKey& key, std::span<const std::byte> file,
                                                           std::pmr::memory_resource* memory) {
  EntryHeader header;
  if (file.size() < sizeof header) return std::nullopt;
  std::memcpy(&header, file.data(), sizeof header);
  const std::span payload = file.subspan(sizeof header);
  if (header.content_bytes > kMaxDiskContent) return std::nullopt;
  EntryHeader expected;
  expected.key = key;
  expected.content_bytes = header.content_bytes;
  expected.payload_bytes = payload.size();
  expected.payload_hash = XXH64(payload.data(), payload.size(), 0);
  if (header != expected) return std::nullopt;
  std::pmr::vector<std::byte> content(static_cast<size_t>(header.content_bytes), memory);
  const size_t unpacked = ZSTD_decompress(content.data(), content.size(), payload.data(), payload.size());
  // ZSTD_decompress returns an error as a number that is larger than every valid size, so this also detects errors.
  if (unpacked != content.size()) return std::nullopt;
  return content;
}

}  // namespace sgm
