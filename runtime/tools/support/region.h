#pragma once
// A region of a grammar's world, meshed and welded, for `mesh` and `render`.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/json.h"
#include "chunk/thin_parts.h"
#include "region/region_mesh.h"
#include "region/region_texture.h"
#include "sgm/sgm.h"
#include "stream/plan/view_target.h"
#include "tools/support/console.h"
#include "tools/support/options.h"

namespace sgm::cli {

struct Region {
  std::shared_ptr<const Program> program;
  RegionMesh meshed;
  int32_t cell = 0;  ///< edge of the grid cells, units; if a view has chosen several levels, that of the coarsest level
  int level = 0;     ///< level of detail, in the world to which these cells belong
  std::vector<Anchor> anchors;  ///< all anchors in the region
  std::string backend, device;
  double seconds = 0;                     ///< wall time from the compiled grammar to the welded mesh
  std::optional<TexturedRegion> texture;  ///< set if the plan requests a texture
  std::optional<Unwrapped> blends;        ///< set if the plan requests blends of materials, but no texture
  /// With sharp features: the closed mesh. In meshed.mesh, each vertex on a crease is split into one for each side.
  std::optional<WorldMesh> unsplit;
  std::string empty_because;                ///< if the mesh has no triangle: a possible reason and the remedy
  std::vector<DeriveNote> notes;            ///< elements that derivation left out, and why
  std::vector<ThinPart> thin;               ///< parts that the mesh may miss
  std::shared_ptr<const WorldField> world;  ///< the mesh's world, if the plan requests to keep it

  uint64_t samples() const { return meshed.chunks * kChunkCells * kChunkCells * kChunkCells; }
};

inline constexpr size_t kCacheBytes = size_t{512} << 20;  ///< limit of the cache of derived cells

/// This user's folder of compiled pipelines, for sgm_runtime_desc.pipeline_folder: sgm/pipelines in $XDG_CACHE_HOME or
/// ~/.cache. Empty if the environment names neither folder.
std::string pipelineFolder();

/// Opens the backend that --backend names. jobs must outlive it. Error: unsupported.
Result<std::unique_ptr<Backend>> backendOf(const WorldOptions& options, JobSystem& jobs);

/// The backend with a name that --backend accepts.
sgm_backend backendNamed(const std::string& name);

/// Prints to stderr which elements derivation left out, each message once for each place in the grammar.
void warnOfNotes(const std::string& file, const std::vector<DeriveNote>& notes);

/// Rejects a region with more chunks than --max-chunks allows, and suggests a larger --cell with which it fits.
Result<void> checkChunks(const WorldOptions& options, const IntBox& region, int32_t finest_cell);

/// Whether the region's border cuts the surface, so that the surface continues beyond it.
bool isCut(const Region& region);

/// The members of --json that all commands print for a region.
Json toJson(const WorldOptions& options, const Region& region);

/// If `region` is empty, an error message has been printed, and `status` is the exit status.
struct RegionResult {
  std::optional<Region> region;
  Exit status = Exit::done;
};

/// Settings and callbacks with which a command controls the meshing of a region; each may be empty.
struct RegionPlan {
  std::string doing = "meshing";  ///< text beside the progress bar
  bool quiet = false;             ///< shows no progress bar
  bool anchors = true;            ///< collects the region's anchors, for which the whole region must be derived
  bool notes = true;              ///< collects Region::notes and Region::thin, which takes time
  /// Called from any thread during the work; false cancels it with Code::cancelled. May be empty.
  std::function<bool()> go_on;
  bool texture = false;     ///< makes texture coordinates and blends of materials
  bool blends = false;      ///< makes blends of materials without texture coordinates
  bool keep_world = false;  ///< keeps the world and its cache in Region::world, for later queries
  /// Called before any work; returns an error to reject a grammar.
  std::function<Result<void>(const Program& program)> check;
  /// Chooses the region in an endless world if there is no --region.
  std::function<Result<IntBox>(const WorldField& world)> choose;
  bool part = false;  ///< `choose` also chooses a part of a finite world, which otherwise is meshed as a whole
  /// If set, cells are made smaller than requested where they would appear too large in this view.
  std::optional<PictureView> view;
  /// Returns the cell edge, units, for the region that `choose` has chosen, if the options do not give it. Empty, or a
  /// result of 0: the size of the region determines the cells.
  std::function<int32_t()> cell;
  /// Called once the region is meshed, for further work on the world.
  std::function<Result<void>(const WorldField& world, Backend& backend, JobSystem& jobs, const Region& region)> after;
};

/// The world of a grammar and a region of it, as the options give them, before any meshing.
struct OpenedWorld {
  std::shared_ptr<const Program> program;  ///< null after an error, whose message has been printed
  Exit status = Exit::done;                ///< the exit status after an error
  WorldFieldSettings settings;
  IntBox region;  ///< the region of --region, otherwise all of a finite world
};

/// Opens a world. An endless world needs a --region, or a plan that chooses a region. Messages go to stderr.
OpenedWorld openWorld(const WorldOptions& options, const RegionPlan& plan = {});

/// Meshes a region of a compiled grammar. The region is chosen as in meshRegion(). Shows a progress bar if stderr is a
/// terminal, but prints no messages. Errors: invalid_argument for wrong options; those of meshing, and of the plan's
/// callbacks.
Result<Region> meshProgram(std::shared_ptr<const Program> program, const WorldOptions& options, const RegionPlan& plan);

/// Reads, compiles and meshes the grammar of the options. The region is that of --region; otherwise all of a finite
/// world, or the plan's choice in an endless one (without a choice, an error). If there is no --cell, the size of the
/// region determines the cells. Messages go to stderr, and a progress bar if stderr is a terminal.
RegionResult meshRegion(const WorldOptions& options, const RegionPlan& plan = {});

}  // namespace sgm::cli
