#include "tools/classify/corpus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/hash.h"
#include "grammar/compile.h"
#include "measure/world_triangles.h"
#include "region/places.h"
#include "region/region_mesh.h"
#include "tools/classify/classify.h"
#include "tools/classify/sample_grammars.h"

namespace sgm::masters {
namespace {

constexpr uint64_t kMaxChunks = 8192;
constexpr size_t kCellBytes = size_t{256} << 20;
/// A box is searched for a surface at the coarsest level that has at least this number of grid cells along the box's
/// longest edge; at level 0 if none has.
constexpr int64_t kSearchCells = 64;
/// Maximum vertical component of the unit normal of a steep surface: it is inclined by at least 60 degrees.
constexpr double kSteep = 0.5;
constexpr size_t kFewestTriangles = 1000;
constexpr uint64_t kAttempts = 10;

/// The text of an embedded grammar. Contract: the file is embedded; in a constant expression, the compiler reports a
/// missing file.
constexpr std::string_view embedded(std::string_view file) {
  for (const EmbeddedGrammar& grammar : kEmbeddedGrammars)
    if (grammar.file == file) return grammar.text;
  throw "no grammar of this name is embedded: CMakeLists.txt lists them";
}

constexpr std::string_view kVoxelText = R"sgm(sgm 1;
units m;
param rock = 50% in 30%..70%;
domain infinite solid limestone;
layer maze cell 32m reach 1m { start Maze; }
rule Maze { cut { ca(1m, fill 1 - rock, rounds 0, threshold 50%, radius 1); } }
)sgm";
constexpr uint32_t kGridSize = 48;

constexpr std::string_view kWoodText = R"sgm(sgm 1;
import "std/plant.sgm" as plant;
units m;
param tall = 12m in 6m..18m;
domain infinite axes xz empty;
layer wood cell 12m reach 20m { start Place; }
rule Place { at(cell.point(jitter 0.5)) Tree(tall*rand(0.7, 1)); }
rule Tree(h) weight 1 { plant.Spruce(h); }
rule Tree(h) weight 1 { plant.Broadleaf(h); }
)sgm";

/// Edge lengths in metres of a grid cell and of the cube that is meshed (0: the whole world). The cube has at most 96
/// cells along an edge, to show enough of a model at low cost.
struct Scale {
  double cell = 0, edge = 0;
};
constexpr std::array kPlainScales{Scale{0.5, 32}, Scale{1, 64}};
constexpr std::array kScales{Scale{0.25, 16}, Scale{0.5, 32}, Scale{1, 64}};
constexpr std::array kTreeScales{Scale{0.1, 8}, Scale{0.25, 16}, Scale{0.5, 32}, Scale{1, 64}};
constexpr std::array kOrchardScales{Scale{0.1, 8}, Scale{0.25, 16}, Scale{0.5, 32}, Scale{0.5, 0}, Scale{1, 64}};
constexpr std::array kSkyScales{Scale{0.5, 48}, Scale{1, 64}, Scale{4, 256}, Scale{8, 512}};
constexpr std::array kWholeScales{Scale{0.25, 0}, Scale{0.5, 0}};
constexpr std::array kGridScales{Scale{0.25, 0}, Scale{0.5, 0}, Scale{1, 0}};
constexpr std::array kVoxelScales{Scale{0.5, 32}, Scale{1, 32}};

struct Kind {
  std::string_view class_name;
  std::span<const Scale> scales;
  std::string_view file;
  /// Width in metres of the central part of a finite world. Only this part is used, to omit the ground around a
  /// building. 0: no limit.
  double middle = 0;
  std::string_view text = embedded(file);
};
constexpr std::array kKinds{
    Kind{"cave", kScales, "cave.sgm"},
    Kind{"cave", kScales, "branchwork.sgm"},
    Kind{"cave", kScales, "lake.sgm"},
    Kind{"cave", kScales, "lava_tube.sgm"},
    Kind{"cave", kScales, "workings.sgm"},
    Kind{"cave", kPlainScales, "tunnels.sgm", 60},
    Kind{"cave", kScales, "table4/cui.sgm"},
    Kind{"cave", kPlainScales, "bench/cave.sgm"},
    Kind{"cave", kPlainScales, "bench/branchwork.sgm"},
    Kind{"cave", kPlainScales, "bench/lake.sgm"},
    Kind{"cave", kPlainScales, "bench/tunnels.sgm"},
    Kind{"cave", kPlainScales, "bench/table4/cui.sgm"},
    Kind{"cloud", kSkyScales, "cloud.sgm"},
    Kind{"cloud", kSkyScales, "table4/birger.sgm"},
    Kind{"cloud", kSkyScales, "table4/bouthors.sgm"},
    Kind{"cloud", kSkyScales, "bench/cloud.sgm"},
    Kind{"cloud", kSkyScales, "bench/table4/birger.sgm"},
    Kind{"cloud", kSkyScales, "bench/table4/bouthors.sgm"},
    Kind{"building", kScales, "building.sgm", 16},
    Kind{"building", kScales, "city.sgm"},
    Kind{"building", kScales, "houses.sgm"},
    Kind{"building", kScales, "nave.sgm", 30},
    Kind{"building", kScales, "terrace.sgm"},
    Kind{"building", kScales, "town.sgm", 100},
    Kind{"building", kScales, "table4/greuter.sgm"},
    Kind{"building", kScales, "table4/lipp.sgm", 32},
    Kind{"building", kScales, "table4/muller.sgm", 40},
    Kind{"building", kScales, "bench/building.sgm"},
    Kind{"building", kScales, "bench/table4/lipp.sgm"},
    Kind{"building", kScales, "bench/table4/muller.sgm"},
    Kind{"building", kWholeScales, "bench/storeys.sgm"},
    Kind{"building", kPlainScales, "bench/castle.sgm"},
    Kind{"building", kPlainScales, "bench/city.sgm"},
    Kind{"building", kPlainScales, "bench/terrace.sgm"},
    Kind{"building", kPlainScales, "bench/table4/greuter.sgm"},
    Kind{"building", kPlainScales, "bench/table4/marson.sgm"},
    Kind{"terrain", kScales, "valley.sgm"},
    Kind{"terrain", kScales, "desert.sgm"},
    Kind{"terrain", kScales, "basalt.sgm"},
    Kind{"tree", kOrchardScales, "tree.sgm"},
    Kind{"tree", kTreeScales, "a wood", 0, kWoodText},
    Kind{measure::kNoise, kVoxelScales, "random voxels", 0, kVoxelText},
    Kind{measure::kNoise, kGridScales, "random grid", 0, ""},
};

constexpr size_t countFamilies() {
  size_t count = 0;
  for (const Kind& kind : kKinds) count += kind.scales.size();
  return count;
}

constexpr auto kFamilies = [] {
  std::array<Family, countFamilies()> all;
  size_t at = 0;
  for (const Kind& kind : kKinds) {
    for (const Scale& scale : kind.scales)
      all[at++] = {kind.class_name, kind.file, kind.text, scale.cell, scale.edge, kind.middle};
  }
  return all;
}();

/// The cube with edge length `edge`, in metres, centred on a point: it contains p if lo <= p < hi.
IntBox cubeAround(const measure::Point& p, double edge) {
  IntBox cube;
  for (int axis = 0; axis < 3; ++axis) {
    cube.lo[axis] = static_cast<int32_t>(std::floor((p[axis] - edge / 2) * kUnitsPerMetre));
    cube.hi[axis] = static_cast<int32_t>(std::floor((p[axis] + edge / 2) * kUnitsPerMetre));
  }
  return cube;
}

/// The central part of a box: `wide` metres along x and z, and the full height.
IntBox middleOf(const IntBox& box, double wide) {
  IntBox middle = box;
  for (const int axis : {0, 2}) {
    const int32_t centre = box.lo[axis] + (box.hi[axis] - box.lo[axis]) / 2;
    const auto half = static_cast<int32_t>(wide / 2 * kUnitsPerMetre);
    middle.lo[axis] = std::max(box.lo[axis], centre - half);
    middle.hi[axis] = std::min(box.hi[axis], centre + half);
  }
  return middle;
}

/// The coarsest level of detail that suffices to search a box for a surface.
int searchLevel(const IntBox& box, int32_t cell) {
  int64_t longest = 0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, int64_t{box.hi[axis]} - box.lo[axis]);
  int level = 0;
  while (level < kMaxLevel && longest / (int64_t{cell} << (level + 1)) >= kSearchCells) ++level;
  return level;
}

bool contains(const IntBox& box, const measure::Point& p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] < metres(box.lo[axis]) || p[axis] >= metres(box.hi[axis])) return false;
  }
  return true;
}

/// A point on a steep surface, selected by `share`, 0..1. Flat ground is avoided: it is most of a village's surface,
/// but tells nothing about the objects on or below it. If the box contains no steep surface, the point is on any
/// surface. Contract: the mesh has triangles.
measure::Point placeOn(const ModelMesh& mesh, const IntBox& box, double share) {
  std::vector<uint32_t> steep;
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const measure::Triangle& t = mesh.triangles[i];
    const measure::Point& a = mesh.points[t[0]];
    const measure::Point normal = cross(mesh.points[t[1]] - a, mesh.points[t[2]] - a);
    if (contains(box, a) && std::fabs(normal[1]) < kSteep * length(normal)) steep.push_back(i);
  }
  const size_t count = steep.empty() ? mesh.triangles.size() : steep.size();
  const auto chosen = static_cast<size_t>(share * static_cast<double>(count));
  return mesh.points[mesh.triangles[steep.empty() ? chosen : steep[chosen]][0]];
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

/// Converts a mesh to metres from the world's origin.
ModelMesh modelOf(const WorldMesh& mesh) {
  ModelMesh model = measure::trianglesOf(mesh);
  const measure::Point origin{metres(mesh.origin.x), metres(mesh.origin.y), metres(mesh.origin.z)};
  for (measure::Point& p : model.points) p = p + origin;
  return model;
}

}  // namespace

std::span<const Family> families() { return kFamilies; }

std::vector<std::string_view> classNames() {
  std::vector<std::string_view> names;
  for (const Kind& kind : kKinds) {
    if (kind.class_name != measure::kNoise && std::ranges::find(names, kind.class_name) == names.end())
      names.push_back(kind.class_name);
  }
  return names;
}

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
  return Error{Code::limit, std::string(family_->file) + ": ten draws gave no surface that could be measured"};
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
    const Result<RegionMesh> whole = meshRegion(world, backend, jobs, *block, 0, kMaxChunks, false);
    if (!whole) return whole.error();
    return modelOf(whole->mesh);
  }
  const IntBox searched = family_->middle > 0 ? middleOf(*block, family_->middle) : *block;
  const int level = searchLevel(searched, world.settings().finest_cell);
  const Result<RegionMesh> coarse = meshRegion(world, backend, jobs, searched, level, kMaxChunks, false);
  if (!coarse) return coarse.error();
  if (coarse->mesh.indices.empty()) return ModelMesh{};
  const IntBox cube = cubeAround(placeOn(modelOf(coarse->mesh), searched, key.unit(0)), family_->edge);
  const Result<RegionMesh> part = meshRegion(world, backend, jobs, cube, 0, kMaxChunks, false);
  if (!part) return part.error();
  return modelOf(part->mesh);
}

}  // namespace sgm::masters
