// Reads files of a store with arbitrary damage: each file is first made correctly, then changed according to the input,
// and its checksums are corrected, so that readers do not stop at the checksums.

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>

#include "base/file_reader.h"
#include "chunk/chunk_codec.h"
#include "store/closure.h"
#include "store/folder.h"
#include "store/index.h"

using namespace sgm;

namespace {

constexpr size_t kMaxChanges = 12;

/// Reads numbers from the fuzzer's input; returns 0 after its end.
struct Input {
  const uint8_t* at;
  size_t left;
  uint32_t next(size_t bytes) {
    uint32_t number = 0;
    for (; bytes > 0 && left > 0; --bytes, --left) number = number << 8 | *at++;
    return number;
  }
};

/// Changes bytes at positions from `first` on, and may truncate the file. The input determines these changes.
void change(Input& input, std::vector<std::byte>& bytes, size_t first) {
  for (size_t i = 0; i < kMaxChanges && input.left > 0 && first < bytes.size(); ++i) {
    const size_t at = first + input.next(3) % (bytes.size() - first);
    bytes[at] = static_cast<std::byte>(input.next(1));
    if (input.next(1) == 0xFF) bytes.resize(at);
  }
}

void require(bool holds) {
  if (!holds) std::abort();
}

std::vector<std::byte> chunkBytes(Input& input) {
  ChunkRecord record;
  const auto part = input.next(1) % 7;
  const auto count = input.next(1) % 20;
  for (uint32_t i = 0; i < count; ++i) {
    Vertex vertex{};
    for (const auto axis : {&Vertex::x, &Vertex::y, &Vertex::z})
      vertex.*axis = static_cast<int16_t>(input.next(2) % 8193);
    vertex.kind = static_cast<uint16_t>(input.next(1) % 3);
    record.mesh.vertices.push_back(vertex);
  }
  for (uint32_t i = 0; count != 0 && i < 3 * (count / 2); ++i) record.mesh.indices.push_back(input.next(1) % count);
  record.mesh.ranges[part] = {0, count, 0, static_cast<uint32_t>(record.mesh.indices.size()), {}};
  if (part != 0) record.seams = static_cast<uint8_t>(1 << (part - 1));
  const auto bytes = encodeChunk(record, std::pmr::get_default_resource());
  return {bytes.begin(), bytes.end()};
}

void readChunk(std::span<const std::byte> bytes) {
  const Result<ChunkRecord> record = decodeChunk(bytes, std::pmr::get_default_resource());
  if (!record) return;
  for (int part = 0; part < 7; ++part) store::bordersOf(record->mesh, part);
}

store::TileRecord recordOf(Input& input, const store::TileKey& key) {
  store::TileRecord record;
  record.key = key;
  const std::vector<std::byte> inlined = chunkBytes(input);
  record.inlined.assign(inlined.begin(), inlined.end());
  for (uint32_t i = input.next(1) % 3; i > 0; --i) record.packs.push_back({{input.next(4), i}, 8 + input.next(3)});
  for (uint32_t i = input.next(1) % 8; i > 0; --i) {
    store::StoredContent content;
    content.id = {input.next(4), i};
    content.pack = store::kInlined;
    content.bytes = content.stored = static_cast<uint32_t>(record.inlined.size());
    record.contents.push_back(content);
  }
  for (uint16_t& part : record.parts) part = static_cast<uint16_t>(input.next(1) % (record.contents.size() + 1));
  return record;
}

void readTile(std::span<const std::byte> bytes) {
  const std::optional<store::TileRecord> record = store::decodeTile(bytes);
  if (!record) return;
  const std::vector<std::byte> again = store::encodeTile(*record);
  require(std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()));
  for (size_t chunk = 0; chunk < store::kTileChunks; ++chunk) {
    for (int part = 0; part < kChunkParts; ++part) {
      const store::StoredContent* content = record->contentOf(chunk, part);
      if (content == nullptr || content->pack != store::kInlined) continue;
      const std::span inlined(record->inlined);
      if (chunk % 64 == 0) readChunk(inlined.subspan(static_cast<size_t>(content->offset), content->stored));
    }
  }
}

struct InMemory final : store::StoredFile {
  std::vector<std::byte> all;
  uint64_t size() const override { return all.size(); }
  Result<std::pmr::vector<std::byte>> read(uint64_t offset, size_t count,
                                           std::pmr::memory_resource* memory) const override {
    if (offset > all.size() || count > all.size() - offset) return Error{Code::io, "the file ends before"};
    const auto first = all.begin() + static_cast<ptrdiff_t>(offset);
    return std::pmr::vector<std::byte>(first, first + static_cast<ptrdiff_t>(count), memory);
  }
};

/// Returns the bytes of a correct index file with two levels.
std::vector<std::byte> writtenIndex() {
  std::string name = (std::filesystem::temp_directory_path() / "sgm_fuzz_XXXXXX").string();
  require(mkdtemp(name.data()) != nullptr);
  const std::filesystem::path file = std::filesystem::path(name) / "index";
  const store::BakedRegion region{{{0, 0, 0}, {1 << 20, 1 << 19, 1 << 19}}, 0, 1, 1024};
  Input none{nullptr, 0};
  auto writer = store::IndexWriter::create(file, nullptr);
  require(bool(writer));
  for (const store::TileKey& tile : store::tilesOf(region))
    require(bool(writer->add(recordOf(none, tile), std::pmr::get_default_resource())));
  require(bool(writer->commit({1, 2}, region)));
  const auto content = readFile(file, 1 << 24);
  require(bool(content));
  std::filesystem::remove_all(name);
  const std::span bytes = std::as_bytes(std::span(*content));
  return {bytes.begin(), bytes.end()};
}

/// Corrects the checksums in the file's trailer and directory, so that damaged contents still pass them.
void mendChecksums(std::vector<std::byte>& bytes) {
  if (bytes.size() < store::kIndexEnd) return;
  const auto put = [&](size_t at, uint64_t number) { std::memcpy(bytes.data() + at, &number, sizeof number); };
  const auto get = [&](size_t at) {
    uint64_t number;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
  };
  const size_t end = bytes.size() - store::kIndexEnd;
  const uint64_t directory = get(bytes.size() - 32);
  if (directory <= end) put(bytes.size() - 16, store::checksumOf(std::span(bytes).subspan(directory, end - directory)));
  put(bytes.size() - 8, store::checksumOf(std::span(bytes).subspan(end, store::kIndexEnd - 8)));
}

void readWorld(const InMemory& file) {
  const Result<store::WorldIndex> index = store::readIndex(file);
  if (!index) return;
  require(bool(store::check(index->region)));
  for (const store::TileEntry& tile : index->tiles) {
    const Result<store::TileRecord> record = store::readRecord(file, tile, std::pmr::get_default_resource());
    require(!record || record->key == tile.key);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::vector<std::byte> index = writtenIndex();
  if (!store::available()) return 0;
  Input input{data, size};
  switch (input.next(1) % 3) {
    case 0: {
      std::vector<std::byte> bytes = chunkBytes(input);
      change(input, bytes, 0);
      readChunk(bytes);
      break;
    }
    case 1: {
      std::vector<std::byte> bytes = store::encodeTile(recordOf(input, {0, {1, 2, 3}}));
      change(input, bytes, 0);
      readTile(bytes);
      break;
    }
    default: {
      InMemory file;
      file.all = index;
      // Three of four inputs change only the last 400 bytes, because these bytes contain the numbers that readers must
      // check.
      change(input, file.all, input.next(1) % 4 == 0 ? 0 : file.all.size() - 400);
      mendChecksums(file.all);
      readWorld(file);
    }
  }
  return 0;
}
