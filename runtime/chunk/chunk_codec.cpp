#include "chunk/chunk_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>

#include "mesh/feature_kind.h"

namespace sgm {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers have the byte order of memory");

struct RecordHeader {
  uint32_t version = kChunkCodecVersion;
  uint32_t vertices = 0, indices = 0, extra = 0;
  uint32_t solid_samples = 0, seams = 0;
  std::array<PackedRange, 7> ranges{};
};
static_assert(sizeof(RecordHeader) == (6 + 7 * 6) * sizeof(uint32_t) && std::is_trivially_copyable_v<RecordHeader>);

constexpr int kMaxPosition = kChunkCells * kSubcell;
constexpr uint32_t kMaxSolid = kChunkCells * kChunkCells * kChunkCells;

/// Writes the words of the records by column, as differences from the previous record. Returns the end of the output.
template <class Word, size_t kWords>
std::byte* splitColumns(const void* records, size_t count, std::byte* to) {
  const auto* from = static_cast<const std::byte*>(records);
  std::array<Word, kWords> before{}, words;
  for (size_t i = 0; i < count; ++i, before = words) {
    std::memcpy(words.data(), from + i * sizeof words, sizeof words);
    for (size_t w = 0; w < kWords; ++w) {
      const auto step = static_cast<Word>(words[w] - before[w]);
      const auto sign = static_cast<Word>(0 - (step >> (8 * sizeof(Word) - 1)));
      const auto folded = static_cast<Word>(static_cast<Word>(step << 1) ^ sign);
      for (size_t b = 0; b < sizeof(Word); ++b) {
        to[(w * sizeof(Word) + b) * count + i] = static_cast<std::byte>(folded >> 8 * b);
      }
    }
  }
  return to + count * sizeof words;
}

/// The inverse of splitColumns(). Returns the end of the input. Works in blocks, so that the compiler can vectorise the
/// loop.
template <class Word, size_t kWords>
const std::byte* joinColumns(const std::byte* from, size_t count, void* records) {
  constexpr size_t kBlock = 64;
  auto* to = static_cast<std::byte*>(records);
  std::array<Word, kWords> words{};
  std::array<std::array<Word, kBlock>, kWords> steps;
  for (size_t first = 0; first < count; first += kBlock) {
    const size_t some = std::min(kBlock, count - first);
    for (size_t w = 0; w < kWords; ++w) {
      const std::byte* column = from + w * sizeof(Word) * count + first;
      for (size_t i = 0; i < some; ++i) {
        Word folded = 0;
        for (size_t b = 0; b < sizeof(Word); ++b) {
          folded = static_cast<Word>(folded | static_cast<Word>(column[b * count + i]) << 8 * b);
        }
        steps[w][i] = static_cast<Word>(folded >> 1 ^ static_cast<Word>(0 - (folded & 1)));
      }
    }
    for (size_t i = 0; i < some; ++i) {
      for (size_t w = 0; w < kWords; ++w) words[w] = static_cast<Word>(words[w] + steps[w][i]);
      std::memcpy(to + (first + i) * sizeof words, words.data(), sizeof words);
    }
  }
  return from + count * sizeof words;
}

Error badRecord(const char* what) { return {Code::bad_input, std::string("an encoded chunk is damaged: ") + what}; }

/// True if the ranges cover the arrays of vertices and indices in order, without gaps or overlaps, and each range uses
/// only its own vertices.
bool rangesFit(const PackedMesh& mesh) {
  size_t vertices = 0, indices = 0;
  for (const PackedRange& range : mesh.ranges) {
    if (range.vertex_count == 0 && range.index_count == 0) {
      if (range.first_vertex > mesh.vertices.size() || range.first_index > mesh.indices.size()) return false;
      continue;
    }
    if (range.first_vertex != vertices || range.first_index != indices || range.index_count % 3 != 0) return false;
    if (range.vertex_count > mesh.vertices.size() - vertices) return false;
    if (range.index_count > mesh.indices.size() - indices) return false;
    const uint32_t* index = mesh.indices.data() + indices;
    for (uint32_t i = 0; i < range.index_count; ++i) {
      if (index[i] < vertices || index[i] - vertices >= range.vertex_count) return false;
    }
    vertices += range.vertex_count;
    indices += range.index_count;
  }
  return vertices == mesh.vertices.size() && indices == mesh.indices.size();
}

}  // namespace

std::pmr::vector<std::byte> encodeChunk(const ChunkRecord& record, std::pmr::memory_resource* memory) {
  const PackedMesh& mesh = record.mesh;
  RecordHeader header;
  header.vertices = static_cast<uint32_t>(mesh.vertices.size());
  header.indices = static_cast<uint32_t>(mesh.indices.size());
  header.extra = static_cast<uint32_t>(record.extra.size());
  header.solid_samples = record.solid_samples;
  header.seams = record.seams;
  header.ranges = mesh.ranges;
  std::pmr::vector<std::byte> bytes(sizeof header + mesh.vertices.size() * sizeof(Vertex) +
                                        mesh.indices.size() * sizeof(uint32_t) + record.extra.size(),
                                    memory);
  std::memcpy(bytes.data(), &header, sizeof header);
  std::byte* to = bytes.data() + sizeof header;
  to = splitColumns<uint16_t, 8>(mesh.vertices.data(), mesh.vertices.size(), to);
  to = splitColumns<uint32_t, 3>(mesh.indices.data(), mesh.indices.size() / 3, to);
  std::copy(record.extra.begin(), record.extra.end(), to);
  return bytes;
}

Result<ChunkRecord> decodeChunk(std::span<const std::byte> bytes, std::pmr::memory_resource* memory) {
  RecordHeader header;
  if (bytes.size() < sizeof header) return badRecord("it is too short");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.version != kChunkCodecVersion) return badRecord("it has another version");
  const uint64_t expected = sizeof header + uint64_t{header.vertices} * sizeof(Vertex) +
                            uint64_t{header.indices} * sizeof(uint32_t) + header.extra;
  if (bytes.size() != expected || header.indices % 3 != 0) return badRecord("its sizes contradict each other");
  if (header.seams >= 1u << 6 || header.solid_samples > kMaxSolid)
    return badRecord("its seams or its solid samples are out of range");

  ChunkRecord record(memory);
  record.seams = static_cast<uint8_t>(header.seams);
  record.solid_samples = header.solid_samples;
  record.mesh.ranges = header.ranges;
  record.mesh.vertices.resize(header.vertices);
  record.mesh.indices.resize(header.indices);
  const std::byte* from = bytes.data() + sizeof header;
  from = joinColumns<uint16_t, 8>(from, header.vertices, record.mesh.vertices.data());
  from = joinColumns<uint32_t, 3>(from, header.indices / 3, record.mesh.indices.data());
  record.extra.assign(from, from + header.extra);

  const auto outside = [](const Vertex& v) {
    const int beyond = isFeature(v.kind) ? 2 * kSubcell : 0;
    return std::max({v.x, v.y, v.z}) > kMaxPosition + beyond || std::min({v.x, v.y, v.z}) < -beyond;
  };
  if (std::any_of(record.mesh.vertices.begin(), record.mesh.vertices.end(), outside)) {
    return badRecord("a vertex lies outside the chunk");
  }
  if (!rangesFit(record.mesh)) return badRecord("its ranges do not fit its vertices and indices");
  return record;
}

}  // namespace sgm
