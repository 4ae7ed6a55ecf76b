#include "store/index.h"

#include <algorithm>

#include "base/bytes.h"

namespace sgm::store {
namespace {

constexpr uint32_t kIndexMagic = 0x574D4753;  // "SGMW"
constexpr size_t kIndexHead = 8, kEntryBytes = 4 * 4 + 8 + 4 + 4 + 8;
constexpr uint32_t kMaxRecord = uint32_t{1} << 24, kMaxFrame = kMaxRecord + kMaxRecord / 128;

std::vector<std::byte> directoryOf(std::span<const TileEntry> tiles) {
  std::vector<std::byte> bytes;
  ByteWriter out(bytes);
  for (const TileEntry& tile : tiles) {
    out.put(int32_t{tile.key.level});
    for (int axis = 0; axis < 3; ++axis) out.put(tile.key.at[axis]);
    out.put(tile.offset);
    out.put(tile.stored);
    out.put(tile.bytes);
    out.put(tile.checksum);
  }
  return bytes;
}

Error damaged(const std::string& what) { return {Code::bad_input, "the world's index is damaged: " + what}; }

}  // namespace

const TileEntry* WorldIndex::find(const TileKey& key) const {
  const auto at =
      std::lower_bound(tiles.begin(), tiles.end(), key, [](const TileEntry& a, const TileKey& b) { return a.key < b; });
  return at != tiles.end() && at->key == key ? &*at : nullptr;
}

IndexWriter::IndexWriter(FileWriter&& writer) : writer_(std::move(writer)) {
  writer_.writeValue(kIndexMagic);
  writer_.writeValue(kIndexVersion);
}

Result<IndexWriter> IndexWriter::create(const std::filesystem::path& file, UnfinishedFiles* unfinished) {
  Result<FileWriter> writer = FileWriter::create(file, unfinished);
  if (!writer) return writer.error();
  return IndexWriter(std::move(*writer));
}

Result<void> IndexWriter::add(const TileRecord& record, std::pmr::memory_resource* memory) {
  const std::vector<std::byte> bytes = encodeTile(record);
  const Result<std::pmr::vector<std::byte>> frame = pack(bytes, memory);
  if (!frame) return frame.error();
  tiles_.push_back({record.key, writer_.bytes(), static_cast<uint32_t>(frame->size()),
                    static_cast<uint32_t>(bytes.size()), checksumOf(*frame)});
  writer_.write(frame->data(), frame->size());
  return {};
}

Result<void> IndexWriter::commit(const ContentId& world, const BakedRegion& region) {
  const std::vector<std::byte> directory = directoryOf(tiles_);
  const uint64_t offset = writer_.bytes();
  writer_.write(directory.data(), directory.size());
  std::vector<std::byte> end;
  ByteWriter out(end);
  putId(world, out);
  putRegion(region, out);
  out.put(uint32_t{0});
  out.put(offset);
  out.put(uint64_t{tiles_.size()});
  out.put(checksumOf(directory));
  out.put(checksumOf(end));
  writer_.write(end.data(), end.size());
  return writer_.commit();
}

Result<WorldIndex> readIndex(const StoredFile& file, std::pmr::memory_resource* memory) {
  const uint64_t file_bytes = file.size();
  const auto read = [&](uint64_t offset, size_t bytes) { return file.read(offset, bytes, memory); };
  if (file_bytes < kIndexHead + kIndexEnd) return damaged("it is truncated");
  const auto head = read(0, kIndexHead);
  if (!head) return head.error();
  ByteReader first(*head);
  if (first.get<uint32_t>() != kIndexMagic) return damaged("it is not an index");
  if (const auto version = first.get<uint32_t>(); version != kIndexVersion)
    return Error{Code::bad_input, "the world's index has version " + std::to_string(version) +
                                      ", but this library reads version " + std::to_string(kIndexVersion)};
  const auto end = read(file_bytes - kIndexEnd, kIndexEnd);
  if (!end) return end.error();
  ByteReader in(*end);
  WorldIndex index(memory);
  index.world = getId(in);
  index.region = getRegion(in);
  in.get<uint32_t>();
  const auto offset = in.get<uint64_t>(), count = in.get<uint64_t>(), checksum = in.get<uint64_t>();
  if (in.get<uint64_t>() != checksumOf(std::span(*end).first(kIndexEnd - 8))) return damaged("its footer is damaged");
  if (!check(index.region) || count != countTiles(index.region)) return damaged("its tiles do not match its region");
  if (count > file_bytes / kEntryBytes || offset != file_bytes - kIndexEnd - count * kEntryBytes)
    return damaged("its size is wrong");
  const auto directory = read(offset, static_cast<size_t>(count * kEntryBytes));
  if (!directory) return directory.error();
  if (checksumOf(*directory) != checksum) return damaged("its directory is damaged");
  ByteReader entries(*directory);
  index.tiles.reserve(static_cast<size_t>(count));
  for (const TileKey& key : tilesOf(index.region)) {
    TileEntry tile;
    tile.key.level = entries.get<int32_t>();
    for (int axis = 0; axis < 3; ++axis) tile.key.at[axis] = entries.get<int32_t>();
    tile.offset = entries.get<uint64_t>();
    tile.stored = entries.get<uint32_t>();
    tile.bytes = entries.get<uint32_t>();
    tile.checksum = entries.get<uint64_t>();
    if (tile.key != key || tile.offset < kIndexHead || tile.offset > offset || tile.stored > offset - tile.offset ||
        tile.bytes > kMaxRecord || tile.stored > kMaxFrame)
      return damaged("its directory has an invalid entry");
    index.tiles.push_back(tile);
  }
  return index;
}

Result<TileRecord> readRecord(const StoredFile& file, const TileEntry& entry, std::pmr::memory_resource* memory) {
  const auto frame = file.read(entry.offset, entry.stored, memory);
  if (!frame) return frame.error();
  if (checksumOf(*frame) != entry.checksum) return damaged("a tile's record is damaged");
  const std::optional<std::pmr::vector<std::byte>> bytes = unpack(*frame, entry.bytes, memory);
  if (!bytes) return damaged("a tile's record cannot be unpacked");
  std::optional<TileRecord> record = decodeTile(*bytes, memory);
  if (!record || record->key != entry.key) return damaged("a tile's record is invalid");
  return std::move(*record);
}

}  // namespace sgm::store
