#pragma once
// What a grammar's `report` and `expect` say of a world.
//
// What is measured
//   watertight  yes where the surface is a manifold and every open edge lies in the region's outer border
//   components  connected pieces of the solid (solid, or nothing written) or of the void (air) inside the region,
//   joined
//               as the mesh joins them (components.h); `above V`: of those whose samples stand for more than V, not
//               measured where one sample does
//   volume      m3 of the solid inside the region, whatever the domain is made of, by the divergence theorem
//               (solid_volume.h)
//   area        m2 of the surface inside the region, without the faces where the border cuts the solid
//   triangles   of that surface
//   genus       handles of the surface, summed over its shells; not measured where the border cuts the surface
//   anchors     inside the region
// What cannot be measured does not hold, and says why.
//
// Where
//   in block(n)  see blockRegion(); otherwise the region that the caller names, else the box of a finite world, else
//                block(1). A region is grown to whole chunks of 32 cells.
//   per Rule     each use of the rule whose frame stands in the region (before it is grown) is measured by itself, the
//                shapes derived below the call as solid in an empty world (RuleInstance in derive/interpret/derive.h
//                says what is left out); the statement must hold for each, and holds where there is none.
// How finely: the caller's cell; otherwise cellFor() the region, or all uses of the rule together.

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
  double volume = 0;  ///< m3 that its samples stand for
  IntBox box;         ///< around them, units
};

/// Pieces that are listed of those that are counted: the smallest.
inline constexpr size_t kMostPieces = 16;

/// One thing measured: the region as a whole, or one use of a rule.
struct Measured {
  std::optional<double> value;          ///< SI; a count; watertight: 1 or 0. Nothing where it cannot be measured
  std::string why;                      ///< it cannot be measured, or is not watertight; else empty
  std::string path;                     ///< of a use of a rule: its derivation path
  Int3 origin;                          ///< of a use of a rule: its frame, in units
  bool holds = true;                    ///< of a report always
  std::vector<MeasuredPiece> pieces{};  ///< components: the smallest of those counted, rising; at most kMostPieces
  std::optional<double> cubes{};        ///< volume: m3 by equation 8 of the paper (cubeVolume() in measure.h)
};

struct Outcome {
  IntBox region;                   ///< grown to whole chunks where it is measured as a whole; hi does not belong to it
  int32_t cell = 0;                ///< units
  uint64_t chunks = 0;             ///< meshed for this statement, alone or together with others
  std::vector<Measured> measured;  ///< one; with `per`, one for each use
  std::optional<Error> error;      ///< the statement could not be evaluated at all
  bool holds() const;              ///< all of `measured`, and no error; of a report: no error
};

struct Evaluation {
  std::vector<Outcome> outcomes;  ///< one for each of Program::expectations, in their order
  std::vector<DeriveNote> notes;  ///< what derivation left out in the regions measured as a whole
};

/// Pure. Statements that look at the same region are answered from the same meshes.
/// Errors: out_of_memory and cancelled. All others are the outcome of the statement that met them.
Result<Evaluation> evaluateExpectations(const ExpectationSettings& settings, Backend& backend, JobSystem& jobs,
                                        std::pmr::memory_resource* memory, const Progress& progress = {});

}  // namespace sgm
