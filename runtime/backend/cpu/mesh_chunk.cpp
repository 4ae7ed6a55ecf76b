#include "backend/cpu/mesh_chunk.h"

#include <algorithm>
#include <bit>

#include "mesh/body.h"
#include "mesh/hash.h"
#include "mesh/seam.h"
#include "mesh/vertex.h"

namespace sgm {

namespace {

// Attributes of the vertices listed in scratch.order[first..last), evaluated together and packed in place.
void evaluateAttributes(const FieldKernels& kernels, const ProgramView& field, const ChunkGrid& grid, MeshPart& part,
                        size_t first, size_t last, ChunkScratch& s) {
  const size_t count = last - first;
  if (count == 0) return;
  s.x.resize(count);
  s.y.resize(count);
  s.z.resize(count);
  s.normal_x.resize(count);
  s.normal_y.resize(count);
  s.label.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const Int3 p = vertexUnits(grid, part.vertices[s.order[first + i]]);
    s.x[i] = p.x;
    s.y[i] = p.y;
    s.z[i] = p.z;
  }
  kernels.attributes(field, {s.x.data(), s.y.data(), s.z.data(), count}, s.evaluation,
                     {nullptr, nullptr, nullptr, nullptr, s.normal_x.data(), s.normal_y.data(), s.label.data()});
  for (size_t i = 0; i < count; ++i) {
    Vertex& v = part.vertices[s.order[first + i]];
    v.normal_x = s.normal_x[i];
    v.normal_y = s.normal_y[i];
    v.material = static_cast<uint16_t>(s.label[i]);
    v.tag = static_cast<uint16_t>(s.label[i] >> 16);
  }
}

size_t brickOf(const Vertex& v) {
  auto at = [](int16_t position) {
    return std::min<size_t>(static_cast<size_t>(position) / (kSubcell * kBrickSamples), kBricks - 1);
  };
  return at(v.x) + kBricks * (at(v.y) + kBricks * at(v.z));
}

// A vertex lies on an edge that begins at a sample of its brick, so the brick's own program holds all that matters
// there.
void fillBody(const FieldKernels& kernels, const ChunkGrid& grid, ChunkScratch& s, MeshPart& body) {
  std::array<uint32_t, kBrickCount + 1> start{};
  for (const Vertex& v : body.vertices) ++start[brickOf(v) + 1];
  for (size_t b = 0; b < kBrickCount; ++b) start[b + 1] += start[b];
  s.order.resize(body.vertices.size());
  std::array<uint32_t, kBrickCount> next{};
  std::copy(start.begin(), start.end() - 1, next.begin());
  for (size_t i = 0; i < body.vertices.size(); ++i)
    s.order[next[brickOf(body.vertices[i])]++] = static_cast<uint32_t>(i);
  for (size_t b = 0; b < kBrickCount; ++b) {
    evaluateAttributes(kernels, s.bricks[b].view(), grid, body, start[b], start[b + 1], s);
  }
}

CoarseFace sampleCoarseFace(const FieldKernels& kernels, const ProgramView& field, const ChunkGrid& grid, Face face,
                            ChunkScratch& s) {
  constexpr size_t count = size_t{kCoarseSamples} * kCoarseSamples;
  s.x.resize(count);
  s.y.resize(count);
  s.z.resize(count);
  s.q.resize(count);
  for (int b = 0; b < kCoarseSamples; ++b) {
    for (int a = 0; a < kCoarseSamples; ++a) {
      const Int3 p = coarseFacePoint(grid, face, a, b);
      const size_t i = static_cast<size_t>(a + b * kCoarseSamples);
      s.x[i] = p.x;
      s.y[i] = p.y;
      s.z[i] = p.z;
    }
  }
  kernels.samples(field, {s.x.data(), s.y.data(), s.z.data(), count}, s.evaluation, s.q.data());
  CoarseFace coarse;
  for (size_t i = 0; i < count; ++i) {
    coarse.q[i] = s.q[i];
    if (s.q[i] < 0) coarse.signs[i / kCoarseSamples] |= 1u << (i % kCoarseSamples);
  }
  return coarse;
}

void meshSeam(const FieldKernels& kernels, const ChunkJob& job, Face face, ChunkScratch& s, MeshPart& seam) {
  const int axis = faceAxis(face);
  IntBox plane{job.grid.origin, job.grid.origin};
  for (int a = 0; a < 3; ++a) plane.hi[a] += kChunkCells * job.grid.cell;
  (faceIsHigh(face) ? plane.lo : plane.hi)[axis] = (faceIsHigh(face) ? plane.hi : plane.lo)[axis];

  // s.whole and s.octant hold nothing that is still wanted: the body is done.
  prune(job.coarse->view(), plane, s.pruning, s.octant);
  const bool coarse_uniform = s.octant.solid() || s.octant.empty();
  CoarseFace coarse;
  if (!coarse_uniform) {
    coarse = sampleCoarseFace(kernels, s.octant.view(), job.grid, face, s);
  } else if (s.octant.solid()) {
    coarse.signs.fill((1u << kCoarseSamples) - 1);
  }
  polygonizeSeam(face, s.samples, coarse, job.grid, job.coarser, seam);
  if (seam.vertices.empty() || job.sums_only) return;

  // Each vertex by the field of its own level. All lie in the face's plane, lateral ones as well, so what pruning to it
  // keeps is all that they need; of a plane proven uniform it keeps nothing, and then a lateral one takes the whole.
  auto attributesOf = [&](bool own_level, const FieldProgram& field, PrunedProgram& pruned, bool pruned_already) {
    s.order.clear();
    for (size_t i = 0; i < seam.vertices.size(); ++i) {
      if ((seam.keys[i].level == job.grid.level) == own_level) s.order.push_back(static_cast<uint32_t>(i));
    }
    if (s.order.empty()) return;
    if (!pruned_already) prune(field.view(), plane, s.pruning, pruned);
    const bool uniform = pruned.solid() || pruned.empty();
    evaluateAttributes(kernels, uniform ? field.view() : pruned.view(), job.grid, seam, 0, s.order.size(), s);
  };
  attributesOf(true, *job.field, s.whole, false);
  attributesOf(false, *job.coarse, s.octant, true);
  hashPart(seam);
}

uint32_t countSolid(const ChunkSamples& samples) {
  constexpr uint64_t lower = (uint64_t{1} << kChunkCells) - 1;
  uint32_t solid = 0;
  for (int z = 0; z < kChunkCells; ++z) {
    for (int y = 0; y < kChunkCells; ++y) {
      solid += static_cast<uint32_t>(std::popcount(samples.signs[static_cast<size_t>(y + z * kChunkSamples)] & lower));
    }
  }
  return solid;
}

/// All of a chunk but its seams.
void fillOwn(const FieldKernels& kernels, const ChunkJob& job, bool uniform, ChunkScratch& s, ChunkMesh& mesh) {
  mesh.uniform = uniform;
  mesh.solid_samples = countSolid(s.samples);
  if (uniform) return;
  if (job.signs) mesh.signs = s.samples.signs;
  polygonizeBody(s.samples, job.grid, mesh.body);
  if (job.sums_only) return;
  fillBody(kernels, job.grid, s, mesh.body);
  hashPart(mesh.body);
}

/// Replaces the meshes by their sums.
void keepSums(ChunkMesh& mesh) {
  const auto keep = [&](MeshPart& part, PartSums& sums) {
    sums = sumsOf(part.vertices, part.indices);
    part = MeshPart(part.vertices.get_allocator().resource());
  };
  keep(mesh.body, mesh.sums[0]);
  for (size_t face = 0; face < mesh.seams.size(); ++face) keep(mesh.seams[face], mesh.sums[1 + face]);
}

void meshParts(const FieldKernels& kernels, const ChunkJob& job, ChunkScratch& s, ChunkMesh& mesh) {
  const bool uniform = !sampleChunk(kernels, job.field->view(), job.grid, s, job.body ? uint8_t{0} : job.seams);
  if (job.body) fillOwn(kernels, job, uniform, s, mesh);
  if (job.seams == 0) return;
  mesh.seams.reserve(6);
  for (int f = 0; f < 6; ++f) {
    mesh.seams.emplace_back(mesh.body.vertices.get_allocator().resource());
    if (job.seams >> f & 1) meshSeam(kernels, job, static_cast<Face>(f), s, mesh.seams.back());
  }
}

}  // namespace

void meshChunk(const FieldKernels& kernels, const ChunkJob& job, ChunkScratch& s, ChunkMesh& mesh) {
  meshParts(kernels, job, s, mesh);
  if (job.sums_only) keepSums(mesh);
}

}  // namespace sgm
