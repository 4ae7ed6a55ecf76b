// Tests that records and indexes are read back as they were written, and that all damage is detected.

#include "store/folder.h"
#include "store/index.h"
#include "store/source.h"
#include "stream/chunk_cache_support.h"

using namespace sgm;

namespace {

store::TileRecord randomRecord(std::mt19937& random) {
  store::TileRecord record;
  record.key = {static_cast<int>(random() % 8),
                {static_cast<int>(random() % 9) - 4, static_cast<int>(random() % 9) - 4, 3}};
  record.chunks = static_cast<uint32_t>(random() % 513);
  record.unshared_bytes = random();
  record.inlined.resize(random() % 400);
  for (std::byte& byte : record.inlined) byte = static_cast<std::byte>(random());
  for (size_t i = random() % 4; i > 0; --i) record.packs.push_back({keyNumber(random()), 1000 + random() % 100000});
  for (size_t i = 1 + random() % 60; i > 0; --i) {
    store::StoredContent content;
    content.id = keyNumber(random());
    if (record.packs.empty() || random() % 2) {
      content.pack = store::kInlined;
      content.stored = content.bytes = static_cast<uint32_t>(random() % (record.inlined.size() + 1));
      content.offset = record.inlined.size() - content.stored;
    } else {
      content.pack = static_cast<uint32_t>(random() % record.packs.size());
      content.bytes = static_cast<uint32_t>(random() % 100000);
      content.stored = static_cast<uint32_t>(random() % 900);
      content.offset =
          store::kPackHead + random() % (record.packs[content.pack].bytes - store::kPackHead - content.stored);
    }
    record.contents.push_back(content);
  }
  for (uint16_t& part : record.parts) part = static_cast<uint16_t>(random() % (record.contents.size() + 1));
  record.measured.triangles = random();
  record.measured.area = static_cast<double>(random()) / 7;
  record.measured.defects[3] = random();
  return record;
}

bool same(const store::TileRecord& a, const store::TileRecord& b) {
  return a.key == b.key && a.packs == b.packs && a.contents == b.contents && a.inlined == b.inlined &&
         a.parts == b.parts && a.chunks == b.chunks && a.unshared_bytes == b.unshared_bytes &&
         a.measured.triangles == b.measured.triangles && a.measured.area == b.measured.area &&
         a.measured.defects == b.measured.defects;
}

struct BytesAsFile final : store::StoredFile {
  const Bytes& all;
  explicit BytesAsFile(const Bytes& bytes) : all(bytes) {}
  uint64_t size() const override { return all.size(); }
  Result<std::pmr::vector<std::byte>> read(uint64_t offset, size_t count,
                                           std::pmr::memory_resource* memory) const override {
    if (offset > all.size() || count > all.size() - offset) return Error{Code::io, "the file ends before"};
    const auto first = all.begin() + static_cast<ptrdiff_t>(offset);
    return std::pmr::vector<std::byte>(first, first + static_cast<ptrdiff_t>(count), memory);
  }
};

}  // namespace

TEST_CASE("a tile's record comes back as it was written, and bytes that are none do not", "[store]") {
  const auto seed = GENERATE(take(2, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  for (unsigned i = 0; i < rounds(20); ++i) {
    const store::TileRecord record = randomRecord(random);
    std::vector<std::byte> bytes = store::encodeTile(record);
    const auto back = store::decodeTile(bytes);
    REQUIRE(back);
    CHECK(same(record, *back));
    CHECK(!store::decodeTile(std::span(bytes).first(bytes.size() - 1)));
    bytes.push_back({});
    CHECK(!store::decodeTile(bytes));
    // Random bytes in a record must not make a reader access bytes outside of the record.
    bytes.pop_back();
    for (int damage = 0; damage < 40; ++damage) bytes[random() % bytes.size()] = static_cast<std::byte>(random());
    if (const auto odd = store::decodeTile(bytes)) {
      for (const uint16_t part : odd->parts) CHECK(part <= odd->contents.size());
      for (const store::StoredContent& content : odd->contents) {
        if (content.pack == store::kInlined) CHECK(content.offset + content.stored <= odd->inlined.size());
      }
    }
  }
}

namespace {

/// An index with random records.
struct RandomIndex {
  store::ContentId world;
  store::BakedRegion region{around(1, 2, 3, 40), 1, 4, 33};
  std::vector<store::TileRecord> records;
  Bytes bytes;

  RandomIndex(std::mt19937& random, const fs::path& file) : world(keyNumber(random())) {
    auto writer = store::IndexWriter::create(file, nullptr);
    REQUIRE(writer);
    for (const store::TileKey& tile : store::tilesOf(region)) {
      records.push_back(randomRecord(random));
      records.back().key = tile;
      REQUIRE(writer->add(records.back(), std::pmr::get_default_resource()));
    }
    REQUIRE(writer->commit(world, region));
    bytes = readFile(file);
  }

  /// Whether the whole index can be read. as_written receives whether the result equals the written index.
  bool canBeRead(bool& as_written) const {
    const auto index = store::readIndex(BytesAsFile(bytes));
    if (!index) return false;
    as_written = index->world == world && index->region.box.lo == region.box.lo &&
                 index->region.last_level == region.last_level && index->tiles.size() == records.size();
    for (size_t i = 0; i < index->tiles.size(); ++i) {
      const auto record = store::readRecord(BytesAsFile(bytes), index->tiles[i], std::pmr::get_default_resource());
      if (!record) return false;
      as_written = as_written && i < records.size() && same(*record, records[i]);
    }
    return true;
  }
};

}  // namespace

TEST_CASE("an index comes back as it was written, and no changed byte passes", "[store]") {
  const auto seed = GENERATE(take(2, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const CacheFolder folder;
  RandomIndex index(random, folder.path / "index");
  REQUIRE(index.records.size() > 10);
  bool as_written = false;
  REQUIRE(index.canBeRead(as_written));
  CHECK(as_written);
  for (unsigned i = 0; i < rounds(100); ++i) {
    const size_t at = random() % index.bytes.size();
    const std::byte was = index.bytes[at];
    index.bytes[at] ^= static_cast<std::byte>(1 + random() % 255);
    CAPTURE(at, index.bytes.size());
    CHECK(!index.canBeRead(as_written));
    index.bytes[at] = was;
  }
  const Bytes whole = index.bytes;
  for (const size_t cut : {size_t{0}, size_t{7}, size_t{90}, whole.size() / 2, whole.size() - 1}) {
    index.bytes.assign(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(cut));
    CHECK(!index.canBeRead(as_written));
  }
}

TEST_CASE("an index whose numbers are wrong on purpose is refused", "[store]") {
  const auto seed = GENERATE(take(1, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const CacheFolder folder;
  const RandomIndex index(random, folder.path / "index");
  // Replaces one of the numbers after the world's hash (the box, two levels, the cell), and corrects the checksum.
  const auto with = [&](size_t number, int32_t value) {
    Bytes bytes = index.bytes;
    std::byte* end = bytes.data() + bytes.size() - store::kIndexEnd;
    std::memcpy(end + 16 + 4 * number, &value, sizeof value);
    const uint64_t checksum = store::checksumOf(std::span(end, store::kIndexEnd - 8));
    std::memcpy(end + store::kIndexEnd - 8, &checksum, sizeof checksum);
    return store::readIndex(BytesAsFile(bytes));
  };
  REQUIRE(with(8, index.region.finest_cell));
  constexpr int32_t kMost = std::numeric_limits<int32_t>::max(), kLeast = std::numeric_limits<int32_t>::min();
  for (const size_t number : {size_t{0}, size_t{3}, size_t{6}, size_t{7}, size_t{8}}) {
    for (const int32_t value : {kLeast, -1, 0, kMost}) {
      CAPTURE(number, value);
      const auto read = with(number, value);
      // A changed corner of the box is accepted if the number of tiles stays the same.
      CHECK((read ? number < 6 && store::countTiles(read->region) == index.records.size()
                  : read.error().code == Code::bad_input));
    }
  }
  // Damages the first tile's entry in the directory: the tile's place, or the position of its record.
  const size_t directory = index.bytes.size() - store::kIndexEnd - 40 * index.records.size();
  for (const size_t at : {size_t{0}, size_t{4}, size_t{8}, size_t{12}, size_t{16}, size_t{24}, size_t{28}}) {
    CAPTURE(at);
    Bytes bytes = index.bytes;
    std::byte* end = bytes.data() + bytes.size() - store::kIndexEnd;
    std::memcpy(bytes.data() + directory + at, &kMost, sizeof kMost);
    uint64_t checksum = store::checksumOf(std::span(bytes.data() + directory, 40 * index.records.size()));
    std::memcpy(end + store::kIndexEnd - 16, &checksum, sizeof checksum);
    checksum = store::checksumOf(std::span(end, store::kIndexEnd - 8));
    std::memcpy(end + store::kIndexEnd - 8, &checksum, sizeof checksum);
    CHECK(store::readIndex(BytesAsFile(bytes)).error().code == Code::bad_input);
  }
}

TEST_CASE("a folder that is no store, or one of another version, stays as it is", "[store]") {
  const CacheFolder folder;
  const store::Folder store(folder.path / "store");
  CHECK(store.check().error().code == Code::bad_input);
  REQUIRE(store.make());
  REQUIRE(store.make());
  CHECK(store.check());
  const std::string other = "sgm store 99\n";
  Bytes text(other.size());
  std::memcpy(text.data(), other.data(), other.size());
  writeFile(store.root() / "format", text);
  CHECK(store.make().error().message.find("sgm store 99") != std::string::npos);
  CHECK(!store::openStores(std::array{store.root().string()}, {}, std::pmr::get_default_resource()));
  // The folder in the state in which a worker leaves it if the worker is killed while it creates a store.
  writeFile(folder.path / "begun" / "format.sgm-part0", text);
  CHECK(store::Folder(folder.path / "begun").make());
  writeFile(folder.path / "other" / "file", text);
  const store::Folder taken(folder.path / "other");
  CHECK(taken.make().error().code == Code::bad_input);
  CHECK(fs::exists(folder.path / "other" / "file"));
  CHECK(!fs::exists(folder.path / "other" / "format"));
}
