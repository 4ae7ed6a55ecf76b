#pragma once
// A region of a grammar's world, meshed and welded: what `mesh` writes and `render` draws.

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
  int32_t cell = 0;             ///< of the level, units: the largest where a view has chosen several
  int level = 0;                ///< of the world that these cells are of
  std::vector<Anchor> anchors;  ///< in the region
  std::string backend, device;
  double seconds = 0;                     ///< from the compiled grammar to the welded mesh
  std::optional<TexturedRegion> texture;  ///< where the plan asks for it
  std::optional<Unwrapped> blends;        ///< the same, where it asks for no coordinates
  /// Where options ask for sharp features: the closed mesh, whose vertices at creases meshed.mesh has once a side.
  std::optional<WorldMesh> unsplit;
  std::string empty_because;                ///< where the mesh has no triangle: why that may be, and what to try
  std::vector<DeriveNote> notes;            ///< what derivation left out
  std::vector<ThinPart> thin;               ///< what its mesh may miss
  std::shared_ptr<const WorldField> world;  ///< that the mesh is of, where the plan keeps it

  uint64_t samples() const { return meshed.chunks * kChunkCells * kChunkCells * kChunkCells; }
};

inline constexpr size_t kCacheBytes = size_t{512} << 20;  ///< of derived cells

/// Where this user's compiled pipelines are kept, as sgm_runtime_desc.pipeline_folder: sgm/pipelines in $XDG_CACHE_HOME
/// or ~/.cache. Empty where neither is known.
std::string pipelineFolder();

/// The backend that --backend names. jobs must outlive it. Error: unsupported.
Result<std::unique_ptr<Backend>> backendOf(const WorldOptions& options, JobSystem& jobs);

/// The backend of that name, as --backend takes it.
sgm_backend backendNamed(const std::string& name);

/// What derivation left out, each message once a place in the grammar, to stderr.
void warnOfNotes(const std::string& file, const std::vector<DeriveNote>& notes);

/// Refuses a region of more chunks than --max-chunks allows, and names a --cell that fits.
Result<void> checkChunks(const WorldOptions& options, const IntBox& region, int32_t finest_cell);

/// Whether the region's border cuts the surface, which goes on beyond it.
bool isCut(const Region& region);

/// What --json says of a region, whatever is done with it.
Json toJson(const WorldOptions& options, const Region& region);

/// Nothing, and the status to end with, where something is wrong; it has been said.
struct RegionResult {
  std::optional<Region> region;
  Exit status = Exit::done;
};

/// What a command wants beside the mesh; each may be empty.
struct RegionPlan {
  std::string doing = "meshing";  ///< beside the progress bar
  bool quiet = false;             ///< no progress bar
  bool anchors = true;            ///< looks for the region's anchors, which takes all of its derivation
  bool notes = true;              ///< asks what derivation left out and what the mesh may miss, which takes its time
  /// Asked from any thread while the work goes on; false ends it with Code::cancelled. Empty: nobody asks.
  std::function<bool()> go_on;
  bool texture = false;     ///< with texture coordinates and blends of materials
  bool blends = false;      ///< with blends of materials alone
  bool keep_world = false;  ///< with its cache, for questions afterwards
  /// Refuses a grammar before any work.
  std::function<Result<void>(const Program& program)> check;
  /// Says which part of an endless world is meant where no --region does.
  std::function<Result<IntBox>(const WorldField& world)> choose;
  bool part = false;  ///< `choose` is asked about a finite world too, which otherwise is taken whole
  /// Meshes with smaller cells than asked for where this view would show them too large.
  std::optional<PictureView> view;
  /// Edge of the cells, units, for the region that `choose` has chosen, where the options do not say; empty or 0: as
  /// large as that needs.
  std::function<int32_t()> cell;
  /// Asks the world for more, once the region is meshed.
  std::function<Result<void>(const WorldField& world, Backend& backend, JobSystem& jobs, const Region& region)> after;
};

/// A grammar's world and a region of it, as the options say, before any work.
struct OpenedWorld {
  std::shared_ptr<const Program> program;  ///< null where something is wrong; it has been said
  Exit status = Exit::done;                ///< to end with then
  WorldFieldSettings settings;
  IntBox region;  ///< --region, else all of a finite world
};

/// Of an endless world there must be a --region, or a plan that chooses one. Messages go to stderr.
OpenedWorld openWorld(const WorldOptions& options, const RegionPlan& plan = {});

/// Meshes what the options say of a grammar that is compiled. The region is as meshRegion() has it. A progress bar goes
/// to stderr where that is a terminal, and no message. Errors: invalid_argument, for what the options say; those of
/// meshing and of the plan.
Result<Region> meshProgram(std::shared_ptr<const Program> program, const WorldOptions& options, const RegionPlan& plan);

/// Reads, compiles and meshes what the options say. The region is --region; without it, all of a finite world, or what
/// the plan chooses of an endless one (else --region must be given), with cells as large as that needs where --cell
/// does not say. Messages go to stderr, a progress bar too where that is a terminal.
RegionResult meshRegion(const WorldOptions& options, const RegionPlan& plan = {});

}  // namespace sgm::cli
