#pragma once
// Meshes a region of a grammar's world and joins its chunks, for commands such as `mesh` and `render`.

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
  /// Edge of the grid cells, units; if a view has chosen cells of several sizes, the edge of the coarsest.
  int32_t cell = 0;
  int level = 0;                ///< level of detail that has been meshed
  std::vector<Anchor> anchors;  ///< all anchors in the region
  std::string backend, device;
  double seconds = 0;                     ///< wall-clock time from the compiled grammar to the finished mesh
  std::optional<TexturedRegion> texture;  ///< set if RegionPlan::texture is true
  std::optional<Unwrapped> blends;        ///< set if RegionPlan::blends is true and RegionPlan::texture is false
  /// Set if the mesh has sharp features: the closed mesh, before vertices were split. In meshed.mesh, each vertex on a
  /// crease is split into one copy for each side of the crease.
  std::optional<WorldMesh> unsplit;
  std::string empty_because;                ///< if the mesh has no triangle: a probable reason and a remedy
  std::vector<DeriveNote> notes;            ///< shapes that derivation left out, and why
  std::vector<ThinPart> thin;               ///< parts that are too thin for the size of the cells, so that the mesh may
                                            ///< lack them
  std::shared_ptr<const WorldField> world;  ///< the meshed world, if RegionPlan::keep_world is true

  uint64_t samples() const { return meshed.chunks * kChunkCells * kChunkCells * kChunkCells; }
};

inline constexpr size_t kCacheBytes = size_t{512} << 20;  ///< limit of the cache of derived cells, bytes

/// The user's directory for compiled pipelines, for sgm_runtime_desc.pipeline_folder: sgm/pipelines in $XDG_CACHE_HOME
/// or in ~/.cache. Empty if neither XDG_CACHE_HOME nor HOME is an absolute path.
std::string pipelineFolder();

/// Opens the backend given by --backend. Contract: jobs outlives the backend. Error: unsupported.
Result<std::unique_ptr<Backend>> backendOf(const WorldOptions& options, JobSystem& jobs);

/// The backend for a value of --backend; SGM_BACKEND_AUTO for an unknown name.
sgm_backend backendNamed(const std::string& name);

/// Prints to stderr which shapes derivation left out: each message once for each place in the grammar.
void warnOfNotes(const std::string& file, const std::vector<DeriveNote>& notes);

/// Error: limit if the region has more chunks than --max-chunks allows. The message suggests a larger --cell that fits.
Result<void> checkChunks(const WorldOptions& options, const IntBox& region, int32_t finest_cell);

/// Whether the mesh reaches the region's border, where the border may cut the surface.
bool isCut(const Region& region);

/// The JSON members that all commands print for a region with --json.
Json toJson(const WorldOptions& options, const Region& region);

/// A meshed region; or, after an error, nullopt and the exit status. The error message has been printed.
struct RegionResult {
  std::optional<Region> region;
  Exit status = Exit::done;
};

/// Settings and callbacks that control how a region is chosen and meshed. Callbacks may be empty.
struct RegionPlan {
  std::string doing = "meshing";  ///< text in front of the progress bar
  bool quiet = false;             ///< true: no progress bar is shown
  bool anchors = true;            ///< whether Region::anchors is filled; this requires the derivation of the whole
                                  ///< region
  bool notes = true;              ///< whether Region::notes and Region::thin are filled, which takes time
  /// Called on any thread during the work; if it returns false, the work is cancelled with Code::cancelled. May be
  /// empty.
  std::function<bool()> go_on;
  bool texture = false;     ///< whether texture coordinates and blends of materials are made
  bool blends = false;      ///< whether blends of materials are made, without texture coordinates
  bool keep_world = false;  ///< whether Region::world keeps the world and its cache for later queries
  /// Called before any other work; rejects a grammar by returning an error.
  std::function<Result<void>(const Program& program)> check;
  /// Chooses the region if there is no --region and the world is endless (or `part` is true).
  std::function<Result<IntBox>(const WorldField& world)> choose;
  bool part = false;  ///< whether `choose` is also called for a finite world, which would otherwise be meshed
                      ///< completely
  /// If set, cells are made smaller where they would look too large in this view.
  std::optional<PictureView> view;
  /// Returns the edge of a cell in units. Called after `choose`, but not if the options determine the cell size. If
  /// this callback is empty or returns 0, the size of the region determines the cell size.
  std::function<int32_t()> cell;
  /// Called when the region has been meshed, to do more with its world.
  std::function<Result<void>(const WorldField& world, Backend& backend, JobSystem& jobs, const Region& region)> after;
};

/// A grammar's world and a region of it, as the options determine them. Nothing is meshed yet.
struct OpenedWorld {
  std::shared_ptr<const Program> program;  ///< null after an error; its message has been printed
  Exit status = Exit::done;                ///< exit status after an error
  WorldFieldSettings settings;
  IntBox region;  ///< the region from --region, from the plan, or all of a finite world
};

/// Opens a world. An endless world requires --region or RegionPlan::choose. Prints errors to stderr.
OpenedWorld openWorld(const WorldOptions& options, const RegionPlan& plan = {});

/// Meshes a region of a compiled grammar; the region is chosen as in meshRegion(). Shows a progress bar if stderr is a
/// terminal, but prints no messages. Errors: invalid_argument for invalid options; those of meshing and of the plan's
/// callbacks.
Result<Region> meshProgram(std::shared_ptr<const Program> program, const WorldOptions& options, const RegionPlan& plan);

/// Reads and compiles the grammar that the options name, and meshes a region. The region is that of --region, otherwise
/// all of a finite world, or the result of RegionPlan::choose; if none of these is given, that is an error. Without
/// --cell or --ld, a chosen region determines the cell size. Prints messages to stderr, and shows a progress bar.
RegionResult meshRegion(const WorldOptions& options, const RegionPlan& plan = {});

}  // namespace sgm::cli
