#include "backend/cpu/mesh_chunk.h"

#include <algorithm>

#include "mesh/seam.h"
#include "mesh/vertex.h"

namespace sgm {

namespace {

/// Evaluates normals and labels (tag << 16 | material) at points first..last - 1 of scratch.mesh, and writes them to
/// the same indices.
void evaluateAttributes(const FieldKernels& kernels, const ProgramView& field, size_t first, size_t last,
                        ChunkScratch& scratch) {
  if (first == last) return;
  MeshScratch& s = scratch.mesh;
  kernels.attributes(field, {s.x.data() + first, s.y.data() + first, s.z.data() + first, last - first},
                     scratch.evaluation,
                     {nullptr, nullptr, nullptr, nullptr, s.normal_x.data() + first, s.normal_y.data() + first,
                      s.label.data() + first});
}

void growAttributes(MeshScratch& s, size_t count) {
  s.normal_x.grow(0, count);
  s.normal_y.grow(0, count);
  s.label.grow(0, count);
}

// Evaluates the attributes of a body's vertices, brick by brick, with the pruned program of each brick. This program is
// valid at the vertices, since each vertex lies on an edge that begins at a sample of its brick.
void fillBody(const ChunkKernels& kernels, ChunkScratch& s, MeshPart& body) {
  std::array<uint32_t, kBrickCount + 1> start;
  kernels.mesh.sort(s.mesh, body.vertices.size(), start);
  growAttributes(s.mesh, body.vertices.size());
  for (size_t b = 0; b < kBrickCount; ++b)
    evaluateAttributes(kernels.field, s.bricks[b].view(), start[b], start[b + 1], s);
  kernels.mesh.attribute(s.mesh, body.vertices.size(), body);
}

CoarseFace sampleCoarseFace(const FieldKernels& kernels, const ProgramView& field, const ChunkGrid& grid, Face face,
                            ChunkScratch& scratch) {
  constexpr size_t count = size_t{kCoarseSamples} * kCoarseSamples;
  MeshScratch& s = scratch.mesh;
  for (RawArray<int32_t>* array : {&s.x, &s.y, &s.z, &s.q}) array->grow(0, count);
  int32_t *x = s.x.data(), *y = s.y.data(), *z = s.z.data();
  for (int b = 0; b < kCoarseSamples; ++b) {
    for (int a = 0; a < kCoarseSamples; ++a) {
      const Int3 p = coarseFacePoint(grid, face, a, b);
      const size_t i = static_cast<size_t>(a + b * kCoarseSamples);
      x[i] = p.x;
      y[i] = p.y;
      z[i] = p.z;
    }
  }
  kernels.samples(field, {x, y, z, count}, scratch.evaluation, s.q.data());
  const int32_t* q = s.q.data();
  CoarseFace coarse;
  for (size_t i = 0; i < count; ++i) {
    coarse.q[i] = q[i];
    if (q[i] < 0) coarse.signs[i / kCoarseSamples] |= 1u << (i % kCoarseSamples);
  }
  return coarse;
}

void meshSeam(const ChunkKernels& kernels, const ChunkJob& job, Face face, ChunkScratch& s, MeshPart& seam) {
  const int axis = faceAxis(face);
  IntBox plane{job.grid.origin, job.grid.origin};
  for (int a = 0; a < 3; ++a) plane.hi[a] += kChunkCells * job.grid.cell;
  (faceIsHigh(face) ? plane.lo : plane.hi)[axis] = (faceIsHigh(face) ? plane.hi : plane.lo)[axis];

  // The body is finished, so s.whole and s.octant can be reused for the seams.
  prune(job.coarse->view(), plane, s.pruning, s.octant);
  const bool coarse_uniform = s.octant.solid() || s.octant.empty();
  CoarseFace coarse;
  if (!coarse_uniform) {
    coarse = sampleCoarseFace(kernels.field, s.octant.view(), job.grid, face, s);
  } else if (s.octant.solid()) {
    coarse.signs.fill((1u << kCoarseSamples) - 1);
  }
  polygonizeSeam(face, s.samples, coarse, job.grid, job.coarser, seam);
  if (seam.vertices.empty() || job.sums_only) return;

  // Evaluates each vertex with the field of its own level, either the chunk's or the coarser one. All vertices of a
  // seam lie in the plane of its face, even the lateral ones (between the two levels), so the program is first pruned
  // to this plane. If pruning proves that the plane is uniform, the pruned program is empty; then the whole program is
  // used.
  auto attributesOf = [&](bool own_level, const FieldProgram& field, PrunedProgram& pruned, bool pruned_already) {
    MeshScratch& m = s.mesh;
    const size_t most = seam.vertices.size();
    m.order.grow(0, most);
    for (RawArray<int32_t>* array : {&m.x, &m.y, &m.z}) array->grow(0, most);
    size_t count = 0;
    for (size_t i = 0; i < most; ++i) {
      if ((seam.keys[i].level == job.grid.level) != own_level) continue;
      const Int3 p = vertexUnits(job.grid, seam.vertices[i]);
      m.order.data()[count] = static_cast<uint32_t>(i);
      m.x.data()[count] = p.x;
      m.y.data()[count] = p.y;
      m.z.data()[count] = p.z;
      ++count;
    }
    if (count == 0) return;
    if (!pruned_already) prune(field.view(), plane, s.pruning, pruned);
    const bool uniform = pruned.solid() || pruned.empty();
    growAttributes(m, count);
    evaluateAttributes(kernels.field, uniform ? field.view() : pruned.view(), 0, count, s);
    kernels.mesh.attribute(m, count, seam);
  };
  attributesOf(true, *job.field, s.whole, false);
  attributesOf(false, *job.coarse, s.octant, true);
  kernels.mesh.hash(seam);
}

/// Makes the body and the signs of a chunk, and counts its solid samples. uniform: the chunk is proven solid or void.
void fillOwn(const ChunkKernels& kernels, const ChunkJob& job, bool uniform, ChunkScratch& s, ChunkMesh& mesh) {
  mesh.uniform = uniform;
  mesh.solid_samples = kernels.mesh.count(s.samples);
  if (uniform) return;
  if (job.signs) mesh.signs = s.samples.signs;
  kernels.mesh.polygonize(s.samples, job.grid, job.keys, s.mesh, mesh.body);
  if (job.sums_only) return;
  fillBody(kernels, s, mesh.body);
  kernels.mesh.hash(mesh.body);
}

/// For ChunkJob::sums_only: replaces each mesh (body and seams) by the sums over its triangles.
void keepSums(ChunkMesh& mesh) {
  const auto keep = [&](MeshPart& part, PartSums& sums) {
    sums = sumsOf(part.vertices, part.indices);
    part = MeshPart(part.vertices.get_allocator().resource());
  };
  keep(mesh.body, mesh.sums[0]);
  for (size_t face = 0; face < mesh.seams.size(); ++face) keep(mesh.seams[face], mesh.sums[1 + face]);
}

void meshParts(const ChunkKernels& kernels, const ChunkJob& job, ChunkScratch& s, ChunkMesh& mesh) {
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

void meshChunk(const ChunkKernels& kernels, const ChunkJob& job, ChunkScratch& s, ChunkMesh& mesh) {
  meshParts(kernels, job, s, mesh);
  if (job.sums_only) keepSums(mesh);
}

}  // namespace sgm
