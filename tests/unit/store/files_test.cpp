// Records and indexes come back as they were written, and no damage passes.

#include "chunk_cache_support.h"
#include "store/folder.h"
#include "store/index.h"
#include "store/source.h"

using namespace sgm;

namespace {

store::TileRecord randomRecord(std::mt19937& random) {
  store::TileRecord record;
  record.key = {static_cast<int>(random() % 8),
                {static_cast<int>(random() % 9) - 4, static_cast<int>(random() % 9) - 4, 3}};
  record.chunks = static_cast<uint32_t>(random() % 513);
  record.plain_bytes = random();
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
         a.parts == b.parts && a.chunks == b.chunks && a.plain_bytes == b.plain_bytes &&
         a.measured.triangles == b.measured.triangles && a.measured.area == b.measured.area &&
         a.measured.defects == b.measured.defects;
}

store::ReadAt readerOf(const Bytes& bytes) {
  return [&bytes](uint64_t offset, size_t count) -> Result<std::vector<std::byte>> {
    if (offset > bytes.size() || count > bytes.size() - offset) return Error{Code::io, "the file ends before"};
    const auto first = bytes.begin() + static_cast<ptrdiff_t>(offset);
    return std::vector<std::byte>(first, first + static_cast<ptrdiff_t>(count));
  };
}

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
    // Whatever stands there, nothing is believed that leads out of the record.
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

TEST_CASE("an index comes back as it was written, and no changed byte passes", "[store]") {
  const auto seed = GENERATE(take(2, random(0, 1 << 30)));
  CAPTURE(seed);
  std::mt19937 random(static_cast<uint32_t>(seed));
  const CacheFolder folder;
  const fs::path file = folder.path / "index";
  std::map<store::TileKey, store::TileRecord> records;
  for (int i = 0; i < 12; ++i) {
    const store::TileRecord record = randomRecord(random);
    records[record.key] = record;
  }
  const store::ContentId world = keyNumber(random());
  const store::BakedRegion region{around(1, 2, 3, 4), 1, 5, 333};
  {
    auto writer = store::IndexWriter::create(file, nullptr);
    REQUIRE(writer);
    for (const auto& [key, record] : records) REQUIRE(writer->add(record, std::pmr::get_default_resource()));
    REQUIRE(writer->commit(world, region));
  }
  Bytes bytes = readFile(file);
  const auto readAll = [&](bool& same_as_written) {
    const auto index = store::readIndex(readerOf(bytes), bytes.size());
    if (!index) return false;
    same_as_written = index->world == world && index->region.box.lo == region.box.lo &&
                      index->region.last_level == region.last_level && index->tiles.size() == records.size();
    for (const store::TileEntry& tile : index->tiles) {
      const auto record = store::readRecord(readerOf(bytes), tile, std::pmr::get_default_resource());
      if (!record) return false;
      same_as_written = same_as_written && records.count(tile.key) != 0 && same(*record, records[tile.key]);
    }
    return true;
  };
  bool as_written = false;
  REQUIRE(readAll(as_written));
  CHECK(as_written);
  for (unsigned i = 0; i < rounds(300); ++i) {
    const size_t at = random() % bytes.size();
    const std::byte was = bytes[at];
    bytes[at] ^= static_cast<std::byte>(1 + random() % 255);
    CAPTURE(at, bytes.size());
    CHECK(!readAll(as_written));
    bytes[at] = was;
  }
  const Bytes whole = bytes;
  for (const size_t cut : {size_t{0}, size_t{7}, size_t{90}, whole.size() / 2, whole.size() - 1}) {
    bytes.assign(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(cut));
    CHECK(!readAll(as_written));
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
  CHECK(!store::openStores(std::array{store.root()}, {}, std::pmr::get_default_resource()));
  writeFile(folder.path / "other" / "file", text);
  const store::Folder taken(folder.path / "other");
  CHECK(taken.make().error().code == Code::bad_input);
  CHECK(fs::exists(folder.path / "other" / "file"));
  CHECK(!fs::exists(folder.path / "other" / "format"));
}
