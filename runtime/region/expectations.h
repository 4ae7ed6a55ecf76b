#pragma once
// Evaluates a grammar's `report` and `expect` statements for a world.
//
// Measures
//   watertight  yes if the surface is a manifold and every open edge lies in the region's outer border
//   components  connected pieces of the solid (solid, the default) or of the void (air) inside the region, joined as
//               the mesh joins them (components.h); `above V`: only pieces whose samples stand for more than V; not
//               measured if one sample stands for more
//   volume      m3 of the solid inside the region, whatever the domain is made of, by the divergence theorem
//               (solid_volume.h)
//   area        m2 of the surface inside the region, without the faces where the border cuts the solid
//   triangles   of that surface
//   genus       handles of the surface, summed over its shells; not measured if the border cuts the surface
//   anchors     inside the region
// A measure that cannot be computed counts as failed, and the result says why.
//
// Regions
//   in block(n)  see blockRegion(); otherwise the region that the caller names, else the box of a finite world, else
//                block(1). A region is grown to whole chunks of 32 cells.
//   per Rule     each use of the rule whose frame stands in the region (before it is grown) is measured separately: the
//                shapes derived below the call, as solid in an empty world (RuleInstance in derive/interpret/derive.h
//                says what is omitted). The statement must hold for each use, and holds if there is none.
// The cell is the caller's; otherwise cellFor() of the region, or of all uses of the rule together.

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
  std::optional<IntBox> region;  ///< lo <= p < hi: the region of statements without `in block(n)`; nullopt: see above
  int32_t cell = 0;              ///< cell edge in units; 0: chosen for each statement
  uint64_t max_chunks = kMeasuredChunks;
  size_t cache_bytes = size_t{64} << 20;
};

struct MeasuredPiece {
  double volume = 0;  ///< m3, computed from the number of its samples
  IntBox box;         ///< bounding box of its samples, in units
};

/// The maximum number of pieces listed in Measured::pieces: the smallest ones.
inline constexpr size_t kMaxPieces = 16;

/// One measurement: of the region as a whole or, with `per`, of one use of a rule.
struct Measured {
  /// in SI units; a count; for watertight 1 or 0. nullopt if it cannot be measured
  std::optional<double> value;
  std::string why;                      ///< the reason why it cannot be measured, or is not watertight; otherwise empty
  std::string path;                     ///< with `per`: the derivation path of the rule's use
  Int3 origin;                          ///< with `per`: the origin of the frame of the rule's use, in units
  bool holds = true;                    ///< whether the expectation holds; true for a report
  std::vector<MeasuredPiece> pieces{};  ///< for components: the smallest counted pieces, ascending; at most kMaxPieces
  /// for volume: m3 by counting cubes, equation 8 of the paper (cubeVolume() in measure.h)
  std::optional<double> cubes{};
};

struct Outcome {
  /// the measured region, grown to whole chunks unless a use of a rule is measured; hi is excluded
  IntBox region;
  int32_t cell = 0;                ///< cell edge in units
  uint64_t chunks = 0;             ///< number of chunks meshed for this statement, alone or together with others
  std::vector<Measured> measured;  ///< one element; with `per`, one for each use of the rule
  std::optional<Error> error;      ///< set if the statement could not be evaluated at all
  /// true if all of `measured` hold and there is no error; for a report, if there is no error
  bool holds() const;
};

struct Evaluation {
  std::vector<Outcome> outcomes;  ///< one for each element of Program::expectations, in the same order
  std::vector<DeriveNote> notes;  ///< omissions of derivation in the regions that were measured as a whole
};

/// Evaluates all statements of a grammar. Pure. Statements about the same region share its meshes. Errors:
/// out_of_memory and cancelled. Any other error becomes the outcome of the statement where it occurred.
Result<Evaluation> evaluateExpectations(const ExpectationSettings& settings, Backend& backend, JobSystem& jobs,
                                        std::pmr::memory_resource* memory, const Progress& progress = {});

}  // namespace sgm
