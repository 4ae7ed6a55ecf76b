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
  int32_t cell = 0;             ///< edge of the level's cells, units: the largest if a view has chosen several levels
  int level = 0;                ///< of detail, in the world that these cells belong to
  std::vector<Anchor> anchors;  ///< in the region
  std::string backend, device;
  double seconds = 0;                     ///< from the compiled grammar to the welded mesh
  std::optional<TexturedRegion> texture;  ///< if the plan asks for it
  std::optional<Unwrapped> blends;        ///< if the plan asks for blends but not for the texture
  /// For sharp features: the closed mesh. At creases, meshed.mesh has a vertex for each side.
  std::optional<WorldMesh> unsplit;
  std::string empty_because;                ///< possible reason if the mesh has no triangle, and the remedy
  std::vector<DeriveNote> notes;            ///< elements that derivation left out
  std::vector<ThinPart> thin;               ///< parts that the mesh may miss
  std::shared_ptr<const WorldField> world;  ///< the mesh's world, if the plan keeps it

  uint64_t samples() const { return meshed.chunks * kChunkCells * kChunkCells * kChunkCells; }
};

inline constexpr size_t kCacheBytes = size_t{512} << 20;  ///< of derived cells

/// This user's folder of compiled pipelines, as sgm_runtime_desc.pipeline_folder: sgm/pipelines in $XDG_CACHE_HOME or
/// ~/.cache. Empty if neither is known.
std::string pipelineFolder();

/// The backend that --backend names. jobs must outlive it. Error: unsupported.
Result<std::unique_ptr<Backend>> backendOf(const WorldOptions& options, JobSystem& jobs);

/// The backend of a name that --backend accepts.
sgm_backend backendNamed(const std::string& name);

/// Prints to stderr what derivation left out, each message once for each place in the grammar.
void warnOfNotes(const std::string& file, const std::vector<DeriveNote>& notes);

/// Rejects a region of more chunks than --max-chunks allows, and suggests a --cell that fits.
Result<void> checkChunks(const WorldOptions& options, const IntBox& region, int32_t finest_cell);

/// Whether the region's border cuts the surface, which continues beyond it.
bool isCut(const Region& region);

/// The common part of --json for a region.
Json toJson(const WorldOptions& options, const Region& region);

/// If region is empty, an error has been printed, and status is the exit status.
struct RegionResult {
  std::optional<Region> region;
  Exit status = Exit::done;
};

/// A command's requests besides the mesh; each may be empty.
struct RegionPlan {
  std::string doing = "meshing";  ///< shown beside the progress bar
  bool quiet = false;             ///< no progress bar
  bool anchors = true;            ///< collects the region's anchors, which takes its full derivation
  bool notes = true;              ///< asks what derivation left out and what the mesh may miss, which takes time
  /// Called from any thread during the work; false cancels it with Code::cancelled. May be empty.
  std::function<bool()> go_on;
  bool texture = false;     ///< with texture coordinates and blends of materials
  bool blends = false;      ///< with blends of materials alone
  bool keep_world = false;  ///< with its cache, for later queries
  /// Rejects a grammar before any work.
  std::function<Result<void>(const Program& program)> check;
  /// Chooses the part of an endless world if there is no --region.
  std::function<Result<IntBox>(const WorldField& world)> choose;
  bool part = false;  ///< `choose` is also asked about a finite world, which otherwise is taken whole
  /// Makes cells smaller than requested where this view would show them too large.
  std::optional<PictureView> view;
  /// Cell edge, units, for the region that `choose` has chosen, if the options do not give it; empty or 0: as large as
  /// that region needs.
  std::function<int32_t()> cell;
  /// Further work on the world, once the region is meshed.
  std::function<Result<void>(const WorldField& world, Backend& backend, JobSystem& jobs, const Region& region)> after;
};

/// A grammar's world and a region of it, from the options, before any work.
struct OpenedWorld {
  std::shared_ptr<const Program> program;  ///< null after an error, which has been printed
  Exit status = Exit::done;                ///< the exit status then
  WorldFieldSettings settings;
  IntBox region;  ///< --region, else all of a finite world
};

/// An endless world needs a --region, or a plan that chooses one. Messages go to stderr.
OpenedWorld openWorld(const WorldOptions& options, const RegionPlan& plan = {});

/// Meshes a region of a compiled grammar. The region is chosen as in meshRegion(). Shows a progress bar on stderr if
/// that is a terminal, and prints no message. Errors: invalid_argument for wrong options; those of meshing and of the
/// plan.
Result<Region> meshProgram(std::shared_ptr<const Program> program, const WorldOptions& options, const RegionPlan& plan);

/// Reads, compiles and meshes the grammar of the options. The region is --region; otherwise all of a finite world, or
/// the plan's choice in an endless one (without either, an error), with cells as large as that region needs if there is
/// no --cell. Messages go to stderr, and a progress bar if that is a terminal.
RegionResult meshRegion(const WorldOptions& options, const RegionPlan& plan = {});

}  // namespace sgm::cli
