#pragma once
// Inputs of the benchmarks of single pipeline stages: the world of a grammar, and the chunks around a viewer in the
// sample cave.

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "chunk/mesh_chunks.h"
#include "grammar/compile.h"
#include "stream/plan/frame.h"
#include "stream/plan/lod_target.h"

namespace bench {

template <class T>
T must(sgm::Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

/// Returns the settings of a world with grid cells of 0.5 m. path: the grammar's file.
inline sgm::WorldFieldSettings settingsOf(const char* path, uint64_t seed) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  sgm::WorldFieldSettings settings;
  settings.program = sgm::compileGrammar(text.str(), path).program;
  if (!settings.program) throw std::runtime_error(std::string("cannot compile ") + path);
  settings.parameters = sgm::ParameterValues::defaults(*settings.program);
  settings.seed = seed;
  return settings;
}

inline std::vector<sgm::ChunkRequest> aroundViewer(int32_t finest_cell) {
  const sgm::LodViewer viewer{{96 * 1024.0, 96 * 1024.0, 96 * 1024.0}};
  sgm::LodSettings lod;
  lod.finest_cell = finest_cell;
  lod.top = 4;
  lod.view_distance = 150 * 1024.0;
  return sgm::frameRequests(sgm::lodTarget({&viewer, 1}, lod));
}

inline sgm::ChunkJob jobOf(const sgm::WorldField& world, const sgm::ChunkRequest& request) {
  sgm::ChunkJob job;
  job.grid = must(chunkGrid(world, request.key));
  job.seams = request.seams;
  job.coarser = request.coarser;
  const sgm::IntBox box = chunkBox(job.grid);
  job.field = must(world.compile(box, request.key.level));
  if (request.seams != 0) job.coarse = must(world.compile(box, request.key.level + 1));
  return job;
}

}  // namespace bench
