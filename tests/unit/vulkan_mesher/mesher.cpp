#include "mesher.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "../mesh/fields.h"
#include "backend/vulkan/case_tables.h"
#include "catch.h"
#include "mesh/hash.h"
#include "mesh/tables.h"
#include "spirv/allocate_comp.h"
#include "spirv/body_vertices_comp.h"
#include "spirv/census_body_comp.h"
#include "spirv/census_seam_comp.h"
#include "spirv/hash_vertices_comp.h"
#include "spirv/list_cells_comp.h"
#include "spirv/seam_triangles_comp.h"
#include "spirv/seam_vertices_comp.h"
#include "spirv/triangles_comp.h"

namespace sgm::test {
namespace {

enum Kernel {
  kCensusBody,
  kCensusSeam,
  kAllocate,
  kBodyVertices,
  kSeamVertices,
  kList,
  kTriangles,
  kSeamTriangles,
  kHash
};

constexpr uint32_t kGuard = 0xBADC0DE5;
constexpr size_t kGuardWords = 256;

/// The contents of the buffers as words, before the first kernel runs.
struct Buffers {
  std::vector<uint32_t> batch, scratch, parts, vertices, indices, tables;
  batch::Sizes sizes;

  uint32_t reserve(size_t words) {
    const size_t at = scratch.size();
    scratch.resize(at + (words + 3) / 4 * 4, kGuard);
    return static_cast<uint32_t>(at);
  }
};

template <class T>
void append(std::vector<uint32_t>& words, const T& record) {
  const size_t at = words.size();
  words.resize(at + sizeof(T) / sizeof(uint32_t));
  std::memcpy(words.data() + at, &record, sizeof(T));
}

Buffers makeBuffers(const MeshInput& input, Room room) {
  Buffers b;
  uint32_t part = 0;
  for (size_t i = 0; i < input.chunks.size(); ++i) {
    const ChunkSamples& samples = input.chunks[i];
    batch::Chunk chunk{};
    chunk.cell = kSpacing;
    chunk.samples = b.reserve(batch::kSampleWords);
    std::memcpy(&b.scratch[chunk.samples], samples.q.data(), samples.q.size() * sizeof(int32_t));
    chunk.signs = b.reserve(batch::kSignWords);
    std::memcpy(&b.scratch[chunk.signs], samples.signs.data(), samples.signs.size() * sizeof(uint64_t));
    chunk.rows = b.reserve(batch::kRowsWords);
    chunk.part = input.with_body[i] ? part++ : batch::kNoRoom;
    append(b.batch, chunk);
  }
  b.sizes.seam_records = static_cast<uint32_t>(b.batch.size());
  for (const SeamInput& s : input.seams) {
    batch::Seam seam{};
    seam.chunk = static_cast<uint32_t>(s.chunk);
    seam.face = static_cast<uint32_t>(s.face);
    seam.samples = b.reserve(batch::kCoarseSampleWords);
    std::memcpy(&b.scratch[seam.samples], s.coarse.q.data(), s.coarse.q.size() * sizeof(int32_t));
    seam.signs = b.reserve(batch::kCoarseSignWords);
    std::copy(s.coarse.signs.begin(), s.coarse.signs.end(), &b.scratch[seam.signs]);
    seam.counts = b.reserve(batch::kSeamCountWords);
    seam.part = part++;
    append(b.batch, seam);
  }
  b.sizes.cell_list = b.reserve(size_t{batch::kCellWords} * room.cells);
  b.reserve(kGuardWords);
  b.sizes = {part, b.sizes.seam_records, b.sizes.cell_list, room.vertices, room.indices, room.cells};
  b.parts.assign(sizeof(batch::Head) / 4 + part * sizeof(batch::Part) / 4 + kGuardWords, kGuard);
  b.vertices.assign(size_t{4} * room.vertices + kGuardWords, kGuard);
  b.indices.assign(room.indices + kGuardWords, kGuard);
  b.tables = caseTables();
  return b;
}

bool allGuards(const std::vector<uint32_t>& words, size_t from) {
  return std::all_of(words.begin() + static_cast<std::ptrdiff_t>(from), words.end(),
                     [](uint32_t word) { return word == kGuard; });
}

}  // namespace

size_t MeshInput::bodies() const { return static_cast<size_t>(std::count(with_body.begin(), with_body.end(), true)); }

std::optional<Mesher> Mesher::create() {
  auto compute = VulkanCompute::create(std::getenv("SGM_REQUIRE_VULKAN") != nullptr, true);
  INFO((compute ? std::string() : compute.error().message));
  REQUIRE(compute);
  if (!*compute) return {};
  Mesher mesher(std::move(**compute));
  const std::span<const uint32_t> kernels[] = {
      spirv::kCensusBodyComp,   spirv::kCensusSeamComp,    spirv::kAllocateComp,
      spirv::kBodyVerticesComp, spirv::kSeamVerticesComp,  spirv::kListCellsComp,
      spirv::kTrianglesComp,    spirv::kSeamTrianglesComp, spirv::kHashVerticesComp};
  for (const auto& kernel : kernels) {
    auto shader = mesher.compute_.shader(kernel, 6, sizeof(batch::Sizes));
    INFO((shader ? std::string() : shader.error().message));
    REQUIRE(shader);
    mesher.shaders_.push_back(std::move(*shader));
  }
  return mesher;
}

MeshOutput Mesher::run(const MeshInput& input, Room room, uint32_t groups) const {
  Buffers b = makeBuffers(input, room);
  const Buffers before = b;
  const ComputeBuffer buffers[] = {computeBuffer(std::span(b.batch)),   computeBuffer(std::span(b.scratch)),
                                   computeBuffer(std::span(b.parts)),   computeBuffer(std::span(b.vertices)),
                                   computeBuffer(std::span(b.indices)), computeBuffer(std::span(b.tables))};
  const auto dispatch = [&](Kernel kernel, size_t count) {
    if (count == 0) return;
    auto done = shaders_[kernel].run(buffers, std::as_bytes(std::span(&b.sizes, 1)), static_cast<uint32_t>(count));
    INFO((done ? std::string() : done.error().message));
    REQUIRE(done);
  };
  const size_t chunks = input.chunks.size(), seams = input.seams.size();
  dispatch(kCensusBody, chunks);
  dispatch(kCensusSeam, seams);
  dispatch(kAllocate, 1);
  dispatch(kBodyVertices, chunks);
  dispatch(kSeamVertices, seams);
  dispatch(kList, chunks);
  MeshOutput out;
  std::memcpy(&out.head, b.parts.data(), sizeof(out.head));
  dispatch(kTriangles, groups != 0 ? groups : out.head.dispatch[0]);
  dispatch(kSeamTriangles, seams);
  dispatch(kHash, b.sizes.part_count);

  out.parts.resize(b.sizes.part_count);
  std::memcpy(out.parts.data(), b.parts.data() + sizeof(batch::Head) / 4, out.parts.size() * sizeof(batch::Part));
  out.vertices.resize(room.vertices);
  std::memcpy(out.vertices.data(), b.vertices.data(), out.vertices.size() * sizeof(Vertex));
  out.indices.assign(b.indices.begin(), b.indices.begin() + room.indices);
  out.guards_kept = allGuards(b.vertices, size_t{4} * out.head.vertices) && allGuards(b.indices, out.head.indices) &&
                    allGuards(b.scratch, b.sizes.cell_list + size_t{batch::kCellWords} * out.head.cells) &&
                    allGuards(b.parts, b.parts.size() - kGuardWords);
  out.inputs_kept = b.batch == before.batch && b.tables == before.tables;
  const auto kept = [&](uint32_t at, size_t words) {
    const auto from = static_cast<std::ptrdiff_t>(at), to = from + static_cast<std::ptrdiff_t>(words);
    out.inputs_kept &= std::equal(b.scratch.begin() + from, b.scratch.begin() + to, before.scratch.begin() + from);
  };
  for (size_t i = 0; i < chunks; ++i) {
    batch::Chunk chunk;
    std::memcpy(&chunk, &b.batch[i * sizeof(chunk) / 4], sizeof(chunk));
    kept(chunk.samples, batch::kSampleWords + batch::kSignWords);
    if (!input.with_body[i]) {
      kept(chunk.rows, batch::kRowsWords);
      continue;
    }
    for (size_t r = 0; r < size_t{kChunkSamples} * kChunkSamples; ++r)
      std::memcpy(&out.rows.emplace_back(), &b.scratch[chunk.rows + 4 * r], 4 * sizeof(uint32_t));
  }
  for (size_t i = 0; i < seams; ++i) {
    batch::Seam seam;
    std::memcpy(&seam, &b.batch[b.sizes.seam_records + i * sizeof(seam) / 4], sizeof(seam));
    kept(seam.samples, batch::kCoarseSampleWords + batch::kCoarseSignWords);
  }
  return out;
}

std::vector<MeshPart> meshOnCpu(const MeshInput& input) {
  const ChunkGrid grid = latticeChunk({0, 0, 0}, 0);
  std::vector<MeshPart> parts;
  for (size_t i = 0; i < input.chunks.size(); ++i)
    if (input.with_body[i]) polygonizeBody(input.chunks[i], grid, parts.emplace_back());
  for (const SeamInput& s : input.seams)
    polygonizeSeam(s.face, input.chunks[s.chunk], s.coarse, grid, neighbourBit(s.face), parts.emplace_back());
  for (MeshPart& part : parts) hashPart(part);
  return parts;
}

uint32_t activeCells(const ChunkSamples& samples) {
  uint32_t count = 0;
  for (size_t z = 0; z < kChunkCells; ++z) {
    for (size_t y = 0; y < kChunkCells; ++y) {
      const uint64_t* row = samples.signs.data() + y + z * kChunkSamples;
      const uint64_t some = row[0] | row[1] | row[kChunkSamples] | row[kChunkSamples + 1];
      const uint64_t each = row[0] & row[1] & row[kChunkSamples] & row[kChunkSamples + 1];
      count += static_cast<uint32_t>(std::popcount(((some | some >> 1) & ~(each & each >> 1)) & 0xFFFFFFFFu));
    }
  }
  return count;
}

Room roomFor(const MeshInput& input, const std::vector<MeshPart>& parts) {
  Room room{0, 0, 0};
  for (const MeshPart& part : parts) {
    room.vertices += static_cast<uint32_t>(part.vertices.size());
    room.indices += static_cast<uint32_t>(part.indices.size());
  }
  for (size_t i = 0; i < input.chunks.size(); ++i) room.cells += input.with_body[i] ? activeCells(input.chunks[i]) : 0;
  return room;
}

namespace {

LatticeField randomField(std::mt19937_64& random) {
  const uint64_t seed = random();
  const auto unit = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
  const double scale = std::exp2(22 * unit()), density = unit();
  std::array<double, 12> w;
  for (double& value : w) value = 0.6 * unit() - 0.3;
  const auto smooth = [=](Int3 p) {
    return std::sin(w[0] * p.x + w[1] * p.y + w[2] * p.z) + std::sin(w[3] * p.x + w[4] * p.y + w[5] * p.z + w[6]) +
           0.5 * std::sin(w[7] * p.x + w[8] * p.y + w[9] * p.z + w[10]) + 4 * w[11];
  };
  switch (random() % 6) {
    case 0:
      return [=](Int3 p, int) { return randomQ(pointHash(seed, p), density); };
    case 1: {  // all samples void, or all solid, except single ones of the other sign
      const int32_t around = seed % 2 != 0 ? 1 : -1;
      return [=](Int3 p, int) {
        const uint64_t hash = pointHash(seed, p);
        return (hash % 2000 == 0 ? -around : around) * static_cast<int32_t>(1 + (hash >> 20) % 1000);
      };
    }
    case 2: {
      const int32_t same = seed % 2 != 0 ? kMaxQ : -kMaxQ;
      return [=](Int3, int) { return same; };
    }
    case 3:  // samples have only the largest or the smallest magnitude
      return [=](Int3 p, int) {
        const bool large = pointHash(seed, p) % 2 != 0;
        return smooth(p) < 0 ? (large ? -kMaxQ : -1) : large ? kMaxQ : 0;
      };
    default:
      return [=](Int3 p, int level) {
        const double f = scale * (smooth(p) + 0.05 * level);
        return static_cast<int32_t>(std::clamp(std::floor(f + 0.5), -1.0 * kMaxQ, 1.0 * kMaxQ));
      };
  }
}

}  // namespace

MeshInput randomInput(std::mt19937_64& random, size_t chunks) {
  MeshInput input;
  for (size_t i = 0; i < chunks; ++i) {
    const LatticeField field = randomField(random), other = randomField(random);
    const ChunkGrid grid =
        latticeChunk({static_cast<int32_t>(random() % 512), static_cast<int32_t>(random() % 512), 64}, 0);
    input.chunks.push_back(sampleChunk(field, grid));
    input.with_body.push_back(random() % 8 != 0);
    for (int f = 0; f < 6; ++f) {
      if (random() % 3 != 0) continue;
      const Face face = static_cast<Face>(f);
      input.seams.push_back({i, face, sampleFace(random() % 4 == 0 ? other : field, grid, face)});
    }
  }
  return input;
}

void requireParts(const MeshOutput& output, const std::vector<MeshPart>& expected, size_t count) {
  uint32_t vertices = 0, indices = 0;
  for (size_t i = 0; i < count; ++i) {
    CAPTURE(i);
    const MeshPart& mesh = expected[i];
    const batch::Part& part = output.parts[i];
    REQUIRE(part.vertices == mesh.vertices.size());
    REQUIRE(part.indices == mesh.indices.size());
    REQUIRE(part.first_vertex == vertices);
    REQUIRE(part.first_index == indices);
    const auto same = [](const Vertex& x, const Vertex& y) { return std::memcmp(&x, &y, sizeof(Vertex)) == 0; };
    const auto vertex =
        std::mismatch(mesh.vertices.begin(), mesh.vertices.end(), output.vertices.begin() + vertices, same);
    REQUIRE(vertex.first - mesh.vertices.begin() == static_cast<std::ptrdiff_t>(mesh.vertices.size()));
    const auto index = std::mismatch(mesh.indices.begin(), mesh.indices.end(), output.indices.begin() + indices);
    REQUIRE(index.first - mesh.indices.begin() == static_cast<std::ptrdiff_t>(mesh.indices.size()));
    REQUIRE(ContentHash{part.hash[0], part.hash[1]} == mesh.hash);
    vertices += part.vertices;
    indices += part.indices;
  }
  REQUIRE(output.head.vertices == vertices);
  REQUIRE(output.head.indices == indices);
}

}  // namespace sgm::test
