#pragma once
// Compares the meshes that two backends have made for the same job, byte by byte, and describes the first difference.

#include <cstring>
#include <string>

#include "backend/backend.h"

namespace sgm {

/// Describes the first word in which two mesh parts differ; empty if they are equal.
inline std::string differenceOf(const MeshPart& expected, const MeshPart& found) {
  const auto count = [](const char* what, size_t a, size_t b) {
    return std::to_string(b) + " " + what + " instead of " + std::to_string(a);
  };
  const auto &u = expected.vertices, &v = found.vertices;
  if (u.size() != v.size()) return count("vertices", u.size(), v.size());
  if (expected.indices.size() != found.indices.size()) {
    return count("indices", expected.indices.size(), found.indices.size());
  }
  if (expected.keys.size() != found.keys.size()) return count("keys", expected.keys.size(), found.keys.size());
  for (size_t i = 0; i < u.size(); ++i) {
    if (std::memcmp(&u[i], &v[i], sizeof(Vertex)) == 0) continue;
    const std::string at = " of vertex " + std::to_string(i) + " of " + std::to_string(u.size());
    if (u[i].x != v[i].x || u[i].y != v[i].y || u[i].z != v[i].z) return "the place" + at;
    if (u[i].normal_x != v[i].normal_x || u[i].normal_y != v[i].normal_y) return "the normal" + at;
    if (u[i].kind != v[i].kind) return "the kind" + at;
    return "the label" + at;
  }
  for (size_t i = 0; i < expected.indices.size(); ++i) {
    if (expected.indices[i] != found.indices[i]) return "index " + std::to_string(i);
  }
  for (size_t i = 0; i < expected.keys.size(); ++i) {
    if (expected.keys[i] != found.keys[i]) return "key " + std::to_string(i);
  }
  return expected.hash == found.hash ? std::string() : "the hash";
}

/// True if all samples of a chunk have the same sign: the number of solid samples is 0 or the maximum, and the signs,
/// if the mesh has them, agree with this number.
inline bool ofOneSign(const ChunkMesh& mesh) {
  constexpr uint64_t kRow = (uint64_t{1} << kChunkSamples) - 1;
  const bool solid = mesh.solid_samples > 0;
  for (const uint64_t row : mesh.signs) {
    if (row != (solid ? kRow : 0)) return false;
  }
  return mesh.solid_samples == (solid ? uint32_t{kChunkCells} * kChunkCells * kChunkCells : 0u);
}

/// Describes the first difference between two meshes of one job; empty if they are equal. The meshes also count as
/// equal if one backend proves a chunk uniform, and the other samples the chunk and finds a single sign.
inline std::string differenceOf(const ChunkMesh& expected, const ChunkMesh& found) {
  if (std::string body = differenceOf(expected.body, found.body); !body.empty()) return "body: " + body;
  if (expected.seams.size() != found.seams.size()) return "the count of seams";
  for (size_t face = 0; face < expected.seams.size(); ++face) {
    const std::string seam = differenceOf(expected.seams[face], found.seams[face]);
    if (!seam.empty()) return "seam " + std::to_string(face) + ": " + seam;
  }
  if (expected.sums != found.sums) return "the sums";
  if (expected.solid_samples != found.solid_samples) return "the count of solid samples";
  if (expected.uniform == found.uniform) return expected.signs == found.signs ? std::string() : "the signs";
  return ofOneSign(expected) && ofOneSign(found) ? std::string() : "whether it is uniform";
}

}  // namespace sgm
