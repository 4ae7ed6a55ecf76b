#include "store/tile_record.h"

#include <algorithm>
#include <cmath>

#include "base/bytes.h"
#include "store/cache/disk_entry.h"

namespace sgm::store {
namespace {

/// Calls f for every number in `sums` in a fixed order, to encode or decode them.
template <class Sums, class F>
void forNumbers(Sums& sums, const F& f) {
  f(sums.bodies);
  f(sums.seams);
  f(sums.triangles);
  f(sums.bytes);
  f(sums.slivers);
  f(sums.against_gradient);
  f(sums.border_edges);
  f(sums.compared);
  for (auto& defect : sums.defects) f(defect);
  f(sums.area);
  for (auto& area : sums.area_vector) f(area);
  f(sums.flux);
}

bool isSound(const TileRecord& record) {
  const auto sound = [&](const StoredContent& content) {
    if (content.pack == kInlined) {
      return content.bytes == content.stored && content.offset <= record.inlined.size() &&
             content.stored <= record.inlined.size() - content.offset;
    }
    if (content.pack >= record.packs.size() || content.bytes > kMaxDiskContent || content.stored > kMaxDiskEntry)
      return false;
    const uint64_t bytes = record.packs[content.pack].bytes;
    return content.offset >= kPackHead && content.offset <= bytes && content.stored <= bytes - content.offset;
  };
  return std::all_of(record.contents.begin(), record.contents.end(), sound) &&
         std::all_of(record.parts.begin(), record.parts.end(),
                     [&](uint16_t part) { return part <= record.contents.size(); });
}

constexpr size_t kContentBytes = 16 + 4 + 4 + 4 + 8, kPackBytes = 16 + 8;

}  // namespace

std::vector<std::byte> packHead() {
  std::vector<std::byte> bytes;
  ByteWriter out(bytes);
  for (const char letter : {'S', 'G', 'M', 'P'}) out.put(letter);
  out.put(kPackVersion);
  return bytes;
}

std::vector<std::byte> encodeTile(const TileRecord& record) {
  std::vector<std::byte> bytes;
  ByteWriter out(bytes);
  out.put(int32_t{record.key.level});
  for (int axis = 0; axis < 3; ++axis) out.put(record.key.at[axis]);
  out.put(record.chunks);
  out.put(record.unshared_bytes);
  out.put(static_cast<uint32_t>(record.packs.size()));
  for (const PackFile& pack : record.packs) {
    putId(pack.name, out);
    out.put(pack.bytes);
  }
  out.put(static_cast<uint32_t>(record.contents.size()));
  for (const StoredContent& content : record.contents) {
    putId(content.id, out);
    out.put(content.bytes);
    out.put(content.stored);
    out.put(content.pack);
    out.put(content.offset);
  }
  for (const uint16_t part : record.parts) out.put(part);
  forNumbers(record.measured, [&](const auto& number) { out.put(number); });
  out.put(static_cast<uint32_t>(record.inlined.size()));
  bytes.insert(bytes.end(), record.inlined.begin(), record.inlined.end());
  return bytes;
}

std::optional<TileRecord> decodeTile(std::span<const std::byte> bytes, std::pmr::memory_resource* memory) {
  ByteReader in(bytes);
  TileRecord record(memory);
  record.key.level = in.get<int32_t>();
  for (int axis = 0; axis < 3; ++axis) record.key.at[axis] = in.get<int32_t>();
  record.chunks = in.get<uint32_t>();
  record.unshared_bytes = in.get<uint64_t>();
  const auto packs = in.get<uint32_t>();
  if (packs > in.left() / kPackBytes) return std::nullopt;
  for (uint32_t i = 0; i < packs; ++i) {
    const ContentId name = getId(in);
    record.packs.push_back({name, in.get<uint64_t>()});
  }
  const auto contents = in.get<uint32_t>();
  if (contents > in.left() / kContentBytes || contents > kTileChunks * kChunkParts) return std::nullopt;
  for (uint32_t i = 0; i < contents; ++i) {
    StoredContent content;
    content.id = getId(in);
    content.bytes = in.get<uint32_t>();
    content.stored = in.get<uint32_t>();
    content.pack = in.get<uint32_t>();
    content.offset = in.get<uint64_t>();
    record.contents.push_back(content);
  }
  for (uint16_t& part : record.parts) part = in.get<uint16_t>();
  forNumbers(record.measured, [&](auto& number) { number = in.get<std::remove_reference_t<decltype(number)>>(); });
  const auto inlined = in.get<uint32_t>();
  if (in.failed() || inlined != in.left()) return std::nullopt;
  record.inlined.assign(bytes.end() - static_cast<ptrdiff_t>(inlined), bytes.end());
  if (!isSound(record)) return std::nullopt;
  return record;
}

}  // namespace sgm::store
