#pragma once
// Derives a grammar chunk from rules, a seed and a cell: the only entry point of derivation.

#include <cstdint>
#include <memory_resource>
#include <string>
#include <vector>

#include "base/fixed.h"
#include "base/result.h"
#include "derive/interpret/lower_layers.h"
#include "derive/parameters.h"
#include "derive/shape.h"
#include "grammar/syntax/program.h"

namespace sgm {

/// Limits for untrusted grammars. Reaching one fails the whole cell; none depends on a clock.
struct DeriveLimits {
  uint64_t steps = 4'000'000;       ///< statements, expressions, candidates of point sets, segments, samples of probes
  uint32_t depth = 64;              ///< rules within rules
  uint32_t nesting = 768;           ///< statements within statements, over all rules; bounds the machine's stack
  uint32_t shapes = 200'000;        ///< before unused ones are dropped
  size_t bytes = size_t{64} << 20;  ///< of the draft, activations, anchors, segments and candidates of a point set
  uint32_t notes = 64;              ///< further notes are counted, not kept
};

/// True for a top-level start, without layers: it derives once, over the domain, as cell 0 0 0; its scope is at the
/// origin.
bool isWhole(const Layer& layer);

/// The box of a cell of the layer; all of an axis if it is not divided into cells; everything without layers. hi is the
/// last unit that still belongs to the cell. Saturates.
IntBox cellBox(const Layer& layer, Int3 cell);

/// Units by which bounds may exceed the declared reach: bounds are rounded outwards, and a shape that reaches exactly
/// as far as declared must not fail because of that rounding.
inline constexpr int32_t kReachSlack = 64;

/// The limit of shapes of the cell: cellBox() grown by the reach and kReachSlack; unlimited along axes that are not
/// divided into cells. Without layers (a top-level start): the domain's box, grown by the slack.
IntBox cellLimit(const Program& program, uint32_t layer, Int3 cell);

/// The interval along an axis that may contain shapes of a layer's cells, both ends included. In units from a cell's
/// low corner, or from the world's origin along axes that are not divided into cells, and without layers. Empty if lo >
/// hi.
struct ShapeSpan {
  int64_t lo = 0, hi = 0;
};

/// cellLimit() as a span, the same for all cells.
ShapeSpan reachSpan(const Program& program, const Layer& layer, int axis);

/// The part of reachSpan() within Layer::bound, with a margin for rounding, if the layer is proven; otherwise all of
/// it.
ShapeSpan shapeSpan(const Program& program, const Layer& layer, int axis);

/// The box that contains every group of the cell: shapeSpan() at the cell. Saturates.
IntBox shapeLimit(const Program& program, uint32_t layer, Int3 cell);

/// Derives a cell. Pure: depends only on the arguments and on the answers of `lower` for layers that this one uses.
/// Thread-safe.
///
/// Shapes that are unbounded or whose bounds are not within cellLimit() are left out, with a note: the whole shape, or,
/// if it has several parts and the rest is within the limit, only parts for which `detail` or `lod` sets levels. A
/// group that exceeds shapeLimit() would mean an error in the proof of reach: an assertion fails in builds with
/// assertions; other builds cut the group off there, with a note. Shapes with sizes that are not positive, and anchors
/// outside the cell (another cell owns those points), are also left out.
///
/// Errors: invalid_argument (unknown layer, a cell beyond the world, a wrong number of parameter values); limit, with
/// the place in the grammar and the derivation path in the message.
Result<GrammarChunk> deriveCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                                uint32_t layer, Int3 cell, const LowerLayers& lower, const DeriveLimits& limits = {},
                                std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Derives only the part of the cell that is visible at levels with this cell edge, in units, or a larger one; without
/// anchors, which belong to the whole cell, and only with notes on derived shapes. Far levels show little of a cell
/// full of windows; this is many times faster and takes a fraction of the memory.
///
/// Pure and thread-safe as deriveCell, and with its errors; but shapes that `detail` leaves out count against no limit.
/// At these levels the shapes produce the same field as those of the whole cell, bit for bit if the field is exact.
Result<GrammarChunk> deriveCoarseCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                                      uint32_t layer, Int3 cell, int32_t cell_edge, const LowerLayers& lower,
                                      const DeriveLimits& limits = {},
                                      std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// The origin of a shape of a cell.
struct ShapeOrigin {
  uint32_t use = 0;  ///< of its statement, into TracedCell::uses
  Span span;         ///< of the statement, or of the call in it
};

/// A cell, and the origins of its shapes.
struct TracedCell {
  GrammarChunk chunk;                ///< the result of deriveCell
  std::vector<ShapeOrigin> origins;  ///< of each of its shapes
  std::vector<std::string> uses;     ///< activations of rules: derivation paths, as in DeriveNote
};

/// deriveCell with the origin of every shape. Takes longer and much more memory.
Result<TracedCell> traceCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                             uint32_t layer, Int3 cell, const LowerLayers& lower, const DeriveLimits& limits = {},
                             std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// One activation of a rule by itself: the shapes derived below the call as groups that add, wherever the call is.
/// Enclosing statements (a cut, a meet, a sum, a smooth union, a displacement, a warp, a morph) are left out, except
/// for the levels of an enclosing `detail` or `lod`. If the rule is a layer's start, its cuts of the domain cut the
/// other shapes; if it has only such cuts, the removed parts count as its shapes.
struct RuleInstance {
  Int3 origin;          ///< of the rule's initial frame, units
  std::string path;     ///< derivation path, "net(0, 0, -1)/Node/Chamber[0]", as in overrides
  bool bounded = true;  ///< otherwise some shape has no bound, and the chunk holds no group
  GrammarChunk chunk;   ///< with the anchors below the call that the cell owns; without notes
};

/// Same as deriveCell, but returns every activation of `rule` in the cell instead of the whole cell; in order of
/// derivation, nested ones after the enclosing ones. Shapes may exceed the layer's reach. Errors: as deriveCell; also
/// limit if the copies have more than limits.shapes shapes in total.
Result<std::vector<RuleInstance>> deriveInstances(const Program& program, const ParameterValues& parameters,
                                                  uint64_t world_seed, uint32_t layer, Int3 cell, uint32_t rule,
                                                  const LowerLayers& lower, const DeriveLimits& limits = {},
                                                  std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
