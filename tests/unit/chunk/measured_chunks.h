#pragma once
// Chunks of the sample grammars, and their measures.

#include <random>
#include <string>

#include "measure/measure_chunk.h"
#include "world/edits_support.h"
#include "world/world_support.h"

namespace sgm::measure {

inline ChunkMeasures measured(const PlacedChunk& chunk) {
  MeasureScratch scratch(std::pmr::get_default_resource());
  ChunkMeasures measures;
  measureBody(viewOf(chunk.mesh.body), chunk.mesh.signs, scratch, measures);
  for (size_t face = 0; face < chunk.mesh.seams.size(); ++face) {
    measures.parts[1 + face] = measureSeam(viewOf(chunk.mesh.seams[face]));
  }
  return measures;
}

inline std::string described(const ChunkMeasures& measures) {
  std::string text;
  for (size_t part = 0; part < measures.parts.size(); ++part) {
    for (size_t kind = 0; kind < kDefects; ++kind) {
      if (measures.parts[part].defects[kind] == 0) continue;
      text += " part " + std::to_string(part) + ": " + std::to_string(measures.parts[part].defects[kind]) + ' ' +
              defectName(static_cast<Defect>(kind)) + ';';
    }
  }
  return text;
}

/// A sample grammar, and a region of its world that has much surface.
struct Excerpt {
  const char* grammar;
  int32_t cell;
  Int3 at;         ///< metres
  int32_t around;  ///< likewise
  bool sharp = false;
};
inline constexpr Excerpt kExcerpts[] = {
    {"cave.sgm", 256, {112, 96, 96}, 24},       {"city.sgm", 512, {40, 8, 40}, 30},
    {"terrain.sgm", 256, {0, 4, 0}, 30},        {"cloud.sgm", 4096, {450, 1200, 450}, 500},
    {"building.sgm", 256, {0, 6, 0}, 12, true}, {"table4/muller.sgm", 512, {0, 8, 0}, 12, true}};

inline ChunkRequest randomRequest(std::mt19937& random, const Excerpt& scene) {
  const Int3 middle{scene.at.x * kUnitsPerMetre, scene.at.y * kUnitsPerMetre, scene.at.z * kUnitsPerMetre};
  const Int3 at = randomPlace(random, IntBox{middle, middle}.grown(scene.around * kUnitsPerMetre));
  ChunkRequest request;
  request.key.level = static_cast<int>(random() % 3);
  const int64_t edge = int64_t{kChunkCells} * scene.cell << request.key.level;
  for (int axis = 0; axis < 3; ++axis) request.key.at[axis] = static_cast<int32_t>(floorDiv(at[axis], edge));
  request.seams = static_cast<uint8_t>(random() % 64);
  request.signs = random() % 2 == 0;
  request.sharp = scene.sharp;
  return request;
}

/// A chunk with much surface, without sharp features.
inline PlacedChunk anyChunk(std::mt19937& random) {
  static const WorldField world(settingsOf(yardstick("cave.sgm"), 256, 3), std::pmr::get_default_resource());
  for (;;) {
    ChunkRequest request = randomRequest(random, kExcerpts[0]);
    request.seams = 0;
    request.signs = true;
    std::pmr::vector<PlacedChunk> chunks = meshAll(world, {request}, 1);
    if (chunks.front().mesh.body.indices.size() > 300) return std::move(chunks.front());
  }
}

}  // namespace sgm::measure
