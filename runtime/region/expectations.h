#pragma once
// Evaluates a grammar's `report` and `expect` statements for a world.
//
// Measures
//   watertight  yes if the surface is a manifold and every open edge lies in the region's outer border
//   components  number of connected pieces of the solid (`solid`, the default) or of the void (`air`) inside the
//   region,
//               connected as in the mesh (components.h); `above V`: only pieces whose samples stand for a volume above
//               V; cannot be measured if one sample stands for more than V
//   volume      m3 of the solid inside the region, whether the domain is solid or void, by the divergence theorem
//               (solid_volume.h)
//   area        m2 of the surface inside the region, without the faces where the border cuts the solid
//   triangles   number of triangles of that surface
//   genus       number of handles of the surface, summed over its shells; cannot be measured if the border cuts the
//               surface
//   anchors     number of anchors inside the region
// A measure that cannot be computed counts as failed, and the result contains the reason.
//
// Regions
//   in block(n)  the region is blockRegion(n). Without `in block(n)`, it is the region that the caller names, or else
//                the box of a finite world, or else block(1). A region is enlarged to whole chunks of 32 cells.
//   per Rule     each use of the rule whose origin lies in the region (before it is enlarged) is measured separately:
//                the shapes derived below the call, as solid in an empty world (RuleInstance in
//                derive/interpret/derive.h says which effects are ignored). The statement must hold for each use, and
//                holds if there is no use.
// The cell edge is the caller's, or else that of cellFor() for the region, or for all uses of the rule together.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "chunk/mesh_chunks.h"
#include "derive/parameters.h"
#include "region/places.h"

namespace sgm {

struct ExpectationSettings {
  std::shared_ptr<const Program> program;
  ParameterValues parameters;
  uint64_t seed = 0;
  /// the region lo <= p < hi of statements without `in block(n)`; nullopt: the default that regionOf() describes
  std::optional<IntBox> region;
  int32_t cell = 0;  ///< cell edge in units; 0: the cell edge is chosen for each statement
  uint64_t max_chunks = kMeasuredChunks;
  size_t cache_bytes = size_t{64} << 20;
};

struct MeasuredPiece {
  double volume = 0;  ///< volume in m3, computed from the number of the piece's samples
  IntBox box;         ///< bounding box of the cubes around the piece's samples, in units
};

/// The maximum number of pieces listed in Measured::pieces, which lists the smallest ones.
inline constexpr size_t kMaxPieces = 16;

/// One measurement: of the region as a whole or, with `per`, of one use of a rule.
struct Measured {
  /// the value in SI units, or a count; for `watertight`, 1 or 0; nullopt if it cannot be measured
  std::optional<double> value;
  /// the reason why the value cannot be measured, or why the surface is not watertight; otherwise empty
  std::string why;
  std::string path;   ///< with `per`: the derivation path of the rule's use
  Int3 origin;        ///< with `per`: the origin of the initial scope of the rule's use, in units
  bool holds = true;  ///< whether the expectation holds; true for a report
  /// for `components`: the smallest pieces that count, ascending; at most kMaxPieces
  std::vector<MeasuredPiece> pieces{};
  /// for `volume`: the volume in m3 by counting cubes, equation 8 of the paper (cubeVolume() in measure.h)
  std::optional<double> cubes{};
};

struct Outcome {
  /// the measured region, enlarged to whole chunks unless uses of a rule are measured; hi is excluded
  IntBox region;
  int32_t cell = 0;  ///< cell edge in units
  /// number of chunks meshed for this statement; another statement about the same region counts the same chunks again
  uint64_t chunks = 0;
  std::vector<Measured> measured;  ///< the measurements: one or, with `per`, one for each use of the rule
  std::optional<Error> error;      ///< set if the statement could not be evaluated
  /// true if all elements of `measured` hold and there is no error; for a report, true if there is no error
  bool holds() const;
};

struct Evaluation {
  std::vector<Outcome> outcomes;  ///< one for each element of Program::expectations, in the same order
  /// notes on content that derivation left out; only of regions that were measured as a whole
  std::vector<DeriveNote> notes;
};

/// Evaluates all statements of a grammar. Pure. Statements about the same region share its meshes. Errors:
/// out_of_memory and cancelled. Any other error becomes the outcome of the statement where it occurred.
Result<Evaluation> evaluateExpectations(const ExpectationSettings& settings, Backend& backend, JobSystem& jobs,
                                        std::pmr::memory_resource* memory, const Progress& progress = {});

}  // namespace sgm
