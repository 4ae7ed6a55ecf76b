#include "masters/corpus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "api/region_mesh.h"
#include "base/hash.h"
#include "grammar/compile.h"
#include "masters/sample_grammars.h"
#include "measure/classify.h"
#include "measure/world_triangles.h"
#include "metrics/places.h"

namespace sgm::masters {
namespace {

constexpr uint64_t kMostChunks = 8192;
constexpr size_t kCellBytes = size_t{256} << 20;
/// Cells on an edge of the world's part that is searched for a surface.
constexpr int64_t kSearchCells = 64;
constexpr size_t kFewestTriangles = 1000;
constexpr uint64_t kAttempts = 10;

constexpr std::string_view kVoxelText = R"sgm(sgm 1;
units m;
param rock = 50% in 30%..70%;
domain infinite solid limestone;
layer maze cell 32m reach 1m { start Maze; }
rule Maze { cut { ca(1m, fill 1 - rock, rounds 0, threshold 50%, radius 1); } }
)sgm";
constexpr uint32_t kGridSize = 48;

constexpr std::array kFamilies{
    Family{"cave", "cave.sgm", kCaveText, 0.5, 48},
    Family{"cave", "cave.sgm", kCaveText, 1, 96},
    Family{"cave", "branchwork.sgm", kBranchworkText, 0.5, 48},
    Family{"cave", "branchwork.sgm", kBranchworkText, 1, 96},
    Family{"cave", "lake.sgm", kLakeText, 0.5, 48},
    Family{"cave", "lake.sgm", kLakeText, 1, 96},
    Family{"cave", "table4/cui.sgm", kCuiText, 0.5, 48},
    Family{"cave", "table4/cui.sgm", kCuiText, 1, 96},
    Family{"cave", "tunnels.sgm", kTunnelsText, 0.5, 48},
    Family{"cave", "tunnels.sgm", kTunnelsText, 1, 96},
    Family{"cloud", "cloud.sgm", kCloudText, 0.5, 48},
    Family{"cloud", "cloud.sgm", kCloudText, 1, 64},
    Family{"cloud", "cloud.sgm", kCloudText, 4, 384},
    Family{"cloud", "cloud.sgm", kCloudText, 8, 768},
    Family{"cloud", "table4/birger.sgm", kBirgerText, 0.5, 48},
    Family{"cloud", "table4/birger.sgm", kBirgerText, 1, 64},
    Family{"cloud", "table4/birger.sgm", kBirgerText, 4, 384},
    Family{"cloud", "table4/birger.sgm", kBirgerText, 8, 768},
    Family{"cloud", "table4/bouthors.sgm", kBouthorsText, 0.5, 48},
    Family{"cloud", "table4/bouthors.sgm", kBouthorsText, 1, 64},
    Family{"cloud", "table4/bouthors.sgm", kBouthorsText, 4, 384},
    Family{"cloud", "table4/bouthors.sgm", kBouthorsText, 8, 768},
    Family{"building", "building.sgm", kBuildingText, 0.25, 0},
    Family{"building", "building.sgm", kBuildingText, 0.5, 0},
    Family{"building", "building.sgm", kBuildingText, 1, 0},
    Family{"building", "storeys.sgm", kStoreysText, 0.25, 0},
    Family{"building", "storeys.sgm", kStoreysText, 0.5, 0},
    Family{"building", "storeys.sgm", kStoreysText, 1, 0},
    Family{"building", "table4/muller.sgm", kMullerText, 0.25, 0},
    Family{"building", "table4/muller.sgm", kMullerText, 0.5, 0},
    Family{"building", "table4/muller.sgm", kMullerText, 1, 0},
    Family{"building", "table4/lipp.sgm", kLippText, 0.25, 0},
    Family{"building", "table4/lipp.sgm", kLippText, 0.5, 0},
    Family{"building", "table4/lipp.sgm", kLippText, 1, 0},
    Family{"building", "table4/marson.sgm", kMarsonText, 0.25, 0},
    Family{"building", "table4/marson.sgm", kMarsonText, 0.5, 0},
    Family{"building", "castle.sgm", kCastleText, 0.5, 48},
    Family{"building", "castle.sgm", kCastleText, 1, 64},
    Family{"building", "city.sgm", kCityText, 0.5, 48},
    Family{"building", "city.sgm", kCityText, 1, 64},
    Family{"building", "terrace.sgm", kTerraceText, 0.5, 48},
    Family{"building", "terrace.sgm", kTerraceText, 1, 64},
    Family{"building", "table4/greuter.sgm", kGreuterText, 0.5, 48},
    Family{"building", "table4/greuter.sgm", kGreuterText, 1, 64},
    Family{measure::kNoise, "random voxels", kVoxelText, 0.5, 32},
    Family{measure::kNoise, "random voxels", kVoxelText, 1, 32},
    Family{measure::kNoise, "random grid", "", 0.25, 0},
    Family{measure::kNoise, "random grid", "", 0.5, 0},
    Family{measure::kNoise, "random grid", "", 1, 0},
};

/// The box of that edge about a point, lo <= p < hi.
IntBox cubeAround(const measure::Point& p, double edge) {
  IntBox cube;
  for (int axis = 0; axis < 3; ++axis) {
    cube.lo[axis] = static_cast<int32_t>(std::floor((p[axis] - edge / 2) * kUnitsPerMetre));
    cube.hi[axis] = static_cast<int32_t>(std::floor((p[axis] + edge / 2) * kUnitsPerMetre));
  }
  return cube;
}

/// How coarse a level may search a box.
int searchLevel(const IntBox& box, int32_t cell) {
  int64_t longest = 0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, int64_t{box.hi[axis]} - box.lo[axis]);
  int level = 0;
  while (level < kMaxLevel && longest / (int64_t{cell} << (level + 1)) >= kSearchCells) ++level;
  return level;
}

ModelMesh randomGrid(double edge, const PathKey& key) {
  const double most = edge * (0.4 + 1.6 * key.unit(0));
  uint64_t draws = 0;
  const auto off = [&] { return most * (2 * key.unit(++draws) - 1); };
  ModelMesh mesh;
  for (uint32_t i = 0; i <= kGridSize; ++i) {
    for (uint32_t j = 0; j <= kGridSize; ++j) {
      const double x = off(), y = off(), z = off();
      mesh.points.push_back({i * edge + x, j * edge + y, z});
    }
  }
  for (uint32_t i = 0; i < kGridSize; ++i) {
    for (uint32_t j = 0; j < kGridSize; ++j) {
      const uint32_t a = i * (kGridSize + 1) + j, b = a + kGridSize + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

/// Metres from the world's origin.
ModelMesh modelOf(const WorldMesh& mesh) {
  ModelMesh model = measure::trianglesOf(mesh);
  const measure::Point origin{metres(mesh.origin.x), metres(mesh.origin.y), metres(mesh.origin.z)};
  for (measure::Point& p : model.points) p = p + origin;
  return model;
}

}  // namespace

std::span<const Family> families() { return kFamilies; }

Result<ModelMaker> ModelMaker::create(const Family& family) {
  if (family.text.empty()) return ModelMaker(family, nullptr);
  const CompileResult compiled = compileGrammar(family.text, family.file);
  if (!compiled.program) return Error{Code::bad_input, renderDiagnostics(compiled)};
  return ModelMaker(family, compiled.program);
}

Result<ModelMesh> ModelMaker::make(uint64_t seed, Backend& backend, JobSystem& jobs) const {
  for (uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
    Result<ModelMesh> mesh = draw(seed, attempt, backend, jobs);
    if (!mesh || mesh->triangles.size() >= kFewestTriangles) return mesh;
  }
  return Error{Code::limit, std::string(family_->file) + ": ten draws give no surface that could be measured"};
}

Result<ModelMesh> ModelMaker::draw(uint64_t seed, uint64_t attempt, Backend& backend, JobSystem& jobs) const {
  const PathKey key = PathKey{hashText(family_->file)}.child(seed, attempt);
  if (!program_) return randomGrid(family_->cell, key);
  WorldFieldSettings settings;
  settings.program = program_;
  settings.parameters = ParameterValues::defaults(*program_);
  settings.seed = key.value;
  settings.finest_cell = static_cast<int32_t>(std::lround(family_->cell * kUnitsPerMetre));
  settings.cache_bytes = kCellBytes;
  for (size_t i = 0; i < program_->params.size(); ++i) {
    const Param& param = program_->params[i];
    if (!param.has_range) continue;
    const double share = key.unit(i + 1);
    settings.parameters.values[i] = param.whole ? param.low + std::floor(share * (param.high - param.low + 1))
                                                : param.low + share * (param.high - param.low);
  }
  const WorldField world(std::move(settings), std::pmr::new_delete_resource());
  const Domain& domain = program_->domain;
  const Result<IntBox> block = domain.infinite ? blockRegion(*program_, 1) : Result<IntBox>(domain.box);
  if (!block) return block.error();
  if (family_->edge == 0) {
    const Result<api::RegionMesh> whole = api::meshRegion(world, backend, jobs, *block, 0, kMostChunks, false);
    if (!whole) return whole.error();
    return modelOf(whole->mesh);
  }
  const int level = searchLevel(*block, world.settings().finest_cell);
  const Result<api::RegionMesh> coarse = api::meshRegion(world, backend, jobs, *block, level, kMostChunks, false);
  if (!coarse) return coarse.error();
  if (coarse->mesh.indices.empty()) return ModelMesh{};
  const ModelMesh found = modelOf(coarse->mesh);
  const auto chosen = static_cast<size_t>(key.unit(0) * static_cast<double>(found.triangles.size()));
  const IntBox cube = cubeAround(found.points[found.triangles[chosen][0]], family_->edge);
  const Result<api::RegionMesh> part = api::meshRegion(world, backend, jobs, cube, 0, kMostChunks, false);
  if (!part) return part.error();
  return modelOf(part->mesh);
}

}  // namespace sgm::masters
