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
// A measure that cannot be computed does not hold, and gives the reason.
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
  std::optional<IntBox> region;  ///< lo <= p < hi; for statements without `in block(n)`
  int32_t cell = 0;              ///< units; 0: chosen for each statement
  uint64_t max_chunks = kMeasuredChunks;
  size_t cache_bytes = size_t{64} << 20;
};

struct MeasuredPiece {
  double volume = 0;  ///< m3, by its samples
  IntBox box;         ///< around its samples, units
};

/// The most pieces listed of those counted: the smallest ones.
inline constexpr size_t kMostPieces = 16;

/// One measurement: of the region as a whole, or of one use of a rule.
struct Measured {
  std::optional<double> value;          ///< SI; a count; watertight: 1 or 0. nullopt if it cannot be measured
  std::string why;                      ///< why it cannot be measured, or is not watertight; else empty
  std::string path;                     ///< of a use of a rule: its derivation path
  Int3 origin;                          ///< of a use of a rule: its frame, in units
  bool holds = true;                    ///< true for a report
  std::vector<MeasuredPiece> pieces{};  ///< components: the smallest of those counted, ascending; at most kMostPieces
  std::optional<double> cubes{};        ///< volume: m3 by equation 8 of the paper (cubeVolume() in measure.h)
};

struct Outcome {
  IntBox region;                   ///< grown to whole chunks if it is measured as a whole; hi is outside
  int32_t cell = 0;                ///< units
  uint64_t chunks = 0;             ///< meshed for this statement, alone or together with others
  std::vector<Measured> measured;  ///< one element; with `per`, one for each use
  std::optional<Error> error;      ///< set if the statement could not be evaluated at all
  bool holds() const;              ///< all of `measured` hold, and no error; for a report: no error
};

struct Evaluation {
  std::vector<Outcome> outcomes;  ///< one for each of Program::expectations, in their order
  std::vector<DeriveNote> notes;  ///< omissions of derivation in the regions measured as a whole
};

/// Pure. Statements about the same region share its meshes. Errors: out_of_memory and cancelled. Any other error is the
/// outcome of the statement where it occurred.
Result<Evaluation> evaluateExpectations(const ExpectationSettings& settings, Backend& backend, JobSystem& jobs,
                                        std::pmr::memory_resource* memory, const Progress& progress = {});

}  // namespace sgm
