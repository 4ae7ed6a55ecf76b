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

/// Limits of the derivation of one cell, for untrusted grammars. Exceeding a limit fails the whole cell. No limit
/// depends on time, so the result is reproducible.
struct DeriveLimits {
  /// maximum number of steps of work: statements, expressions, candidates of point sets, segments, samples of probes
  uint64_t steps = 4'000'000;
  uint32_t depth = 64;        ///< maximum depth of calls of rules by rules
  uint32_t nesting = 768;     ///< maximum depth of nested statements, over all rules; limits the stack
  uint32_t shapes = 200'000;  ///< maximum number of derived shapes, including those that are later dropped as unused
  /// maximum memory in bytes of the draft, activations, anchors, segments and candidates of point sets
  size_t bytes = size_t{64} << 20;
  uint32_t notes = 64;  ///< maximum number of stored notes; further notes are only counted
};

/// Whether the layer is the top-level start of a grammar without layers. Such a layer is derived once for the whole
/// domain, as cell 0 0 0, with its scope at the origin.
bool isWhole(const Layer& layer);

/// Returns the box of a cell in units, both ends included. The box is unlimited along axes without cells, and on all
/// axes for a top-level start. Saturates at the ends of the world.
IntBox cellBox(const Layer& layer, Int3 cell);

/// Tolerance in units by which bounds may exceed the declared reach: bounds are rounded outwards, and a shape that
/// extends exactly to the declared reach must be accepted.
inline constexpr int32_t kReachSlack = 64;

/// Returns the box within which the shapes of a cell must lie: cellBox() grown by the layer's reach and kReachSlack,
/// unlimited along axes without cells. For a top-level start, it is the domain's box grown by kReachSlack.
IntBox cellLimit(const Program& program, uint32_t layer, Int3 cell);

/// The interval along one axis, in units, that may contain shapes of a layer's cell; both ends are included. It is
/// relative to the cell's low corner; along axes without cells, and for a top-level start, it is relative to the
/// world's origin. Empty if lo > hi.
struct ShapeSpan {
  int64_t lo = 0, hi = 0;
};

/// Returns the interval to which cellLimit() restricts shapes along an axis, relative to the origin that ShapeSpan
/// describes. This interval is the same for all cells of the layer.
ShapeSpan reachSpan(const Program& program, const Layer& layer, int axis);

/// Returns the interval that shapes can really reach. If Layer::bound is proven (Layer::proven), it is the part of
/// reachSpan() within that bound, plus a margin for rounding; otherwise, it is reachSpan().
ShapeSpan shapeSpan(const Program& program, const Layer& layer, int axis);

/// Returns the box that contains all groups of the cell: the interval shapeSpan() on each axis. Saturates at the ends
/// of the world.
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

/// Derives only the part of the cell that is visible at levels with cell edges of `cell_edge` units or more. Returns no
/// anchors, which belong to the complete cell, and notes only about shapes that are derived. At coarse levels little of
/// a cell full of windows is visible, so this is many times faster and needs a fraction of the memory.
///
/// Pure and thread-safe, with the same errors as deriveCell(), except that shapes left out by `detail` do not count
/// against limits. At these levels the result has the same field as the complete cell, bit for bit if the field is
/// exact.
Result<GrammarChunk> deriveCoarseCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                                      uint32_t layer, Int3 cell, int32_t cell_edge, const LowerLayers& lower,
                                      const DeriveLimits& limits = {},
                                      std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// The origin of a shape: its rule activation and its place in the grammar.
struct ShapeOrigin {
  uint32_t use = 0;  ///< index in TracedCell::uses of the activation that contains the shape's statement
  Span span;         ///< source span of the shape's statement, or of the call in that statement
};

/// A derived cell with the origin of each shape.
struct TracedCell {
  GrammarChunk chunk;                ///< the result of deriveCell
  std::vector<ShapeOrigin> origins;  ///< origin of each shape of `chunk`, in the same order
  std::vector<std::string> uses;     ///< derivation paths of the activations, in the format of DeriveNote::path
};

/// Returns the result of deriveCell() with the origin of every shape. Takes longer and much more memory.
Result<TracedCell> traceCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                             uint32_t layer, Int3 cell, const LowerLayers& lower, const DeriveLimits& limits = {},
                             std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// The content of one activation of a rule: the shapes derived below its call, as groups that add, whatever statements
/// enclose the call. The effects of enclosing statements (cut, meet, sum, smooth union, displace, warp, morph) are
/// ignored, except the levels of an enclosing `detail` or `lod`. If the rule is a layer's start, its cuts of the domain
/// cut the rule's other shapes; if it has only such cuts, the removed solids count as its shapes.
struct RuleInstance {
  Int3 origin;          ///< origin of the rule's initial scope, units
  std::string path;     ///< derivation path, such as "net(0, 0, -1)/Node/Chamber[0]", in the format of overrides
  bool bounded = true;  ///< false: some shape is unbounded; `chunk` then contains no groups
  GrammarChunk chunk;   ///< shapes of the activation, and those of its anchors that lie within the cell; no notes
};

/// Like deriveCell(), but returns each activation of `rule` in the cell separately, in order of derivation: a nested
/// activation follows the activation that encloses it. Shapes may exceed the layer's reach. Errors: those of
/// deriveCell(); also limit, if all copies together have more than limits.shapes shapes.
Result<std::vector<RuleInstance>> deriveInstances(const Program& program, const ParameterValues& parameters,
                                                  uint64_t world_seed, uint32_t layer, Int3 cell, uint32_t rule,
                                                  const LowerLayers& lower, const DeriveLimits& limits = {},
                                                  std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
