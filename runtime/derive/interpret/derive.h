#pragma once
// Rules, seed and cell to a grammar chunk: the one entry of derivation.

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

/// Caps for grammar text that nobody vouches for. Reaching one fails the whole cell; none depends on a clock.
struct DeriveLimits {
  uint64_t steps = 4'000'000;       ///< statements, expressions, candidates of point sets, segments, samples of probes
  uint32_t depth = 64;              ///< rules within rules
  uint32_t nesting = 768;           ///< statements within statements, over all rules; bounds the machine's stack
  uint32_t shapes = 200'000;        ///< before unused ones are dropped
  size_t bytes = size_t{64} << 20;  ///< of the draft, uses of rules, anchors, segments and candidates of a point set
  uint32_t notes = 64;              ///< further notes are counted, not kept
};

/// A top-level start, without layers: it derives once, over the domain, as cell 0 0 0; its scope stands at the origin.
bool isWhole(const Layer& layer);

/// The box that a cell of the layer covers; along axes that are not cut into cells, all of the axis; without layers,
/// everything. hi is the last unit that still belongs to the cell. Saturates.
IntBox cellBox(const Layer& layer, Int3 cell);

/// Units by which bounds may pass the declared reach: bounds are rounded outwards, and a shape that reaches exactly as
/// far as declared must not fall to that rounding.
inline constexpr int32_t kReachSlack = 64;

/// The box that shapes of the cell must not pass: cellBox() grown by the reach and kReachSlack; along axes that are not
/// cut into cells there is no limit. Without layers (a top-level start): the domain's box, grown by the slack.
IntBox cellLimit(const Program& program, uint32_t layer, Int3 cell);

/// Where the shapes of a layer's cells may lie along an axis, both ends included. In units from a cell's low corner;
/// along axes that are not cut into cells, and without layers, from the world's origin. Empty where lo > hi.
struct ShapeSpan {
  int64_t lo = 0, hi = 0;
};

/// cellLimit() as a span, the same for all cells.
ShapeSpan reachSpan(const Program& program, const Layer& layer, int axis);

/// Of a proven layer the part of reachSpan() within Layer::bound, with room for rounding; otherwise all of it.
ShapeSpan shapeSpan(const Program& program, const Layer& layer, int axis);

/// The box that holds every group of the cell: shapeSpan() at the cell. Saturates.
IntBox shapeLimit(const Program& program, uint32_t layer, Int3 cell);

/// Pure: a value of the arguments and of what `lower` answers for layers that this one uses. Thread-safe.
///
/// Shapes whose bounds are not within cellLimit(), or that have no bound, are left out whole, with a note: of a shape
/// of several parts, those parts alone that `detail` or `lod` sets levels for, where the rest is within it. A group
/// that passed shapeLimit() would show a fault in the proof of reach: an assertion fails in builds with assertions;
/// others end the group there, with a note. Left out as well are shapes with sizes that are not positive, and anchors
/// outside of the cell (another cell owns those points).
///
/// Errors: invalid_argument (no such layer, a cell beyond the world, as many parameter values as there are not);
/// limit, with the place in the grammar and the derivation path in the message.
Result<GrammarChunk> deriveCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                                uint32_t layer, Int3 cell, const LowerLayers& lower, const DeriveLimits& limits = {},
                                std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Of the cell what levels show whose cells have this edge, units, or a larger one; without anchors, which are those of
/// the whole cell, and with the notes of what was derived alone. Far levels show little of a cell full of windows, and
/// that is derived many times faster and kept in a fraction of the memory.
///
/// Pure and thread-safe as deriveCell, and with its errors; but what `detail` leaves out counts against no limit. At
/// these levels the shapes make the field that those of the whole cell make, bit for bit where the field is exact.
Result<GrammarChunk> deriveCoarseCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                                      uint32_t layer, Int3 cell, int32_t cell_edge, const LowerLayers& lower,
                                      const DeriveLimits& limits = {},
                                      std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// Where a shape of a cell comes from.
struct ShapeOrigin {
  uint32_t use = 0;  ///< TracedCell::uses: whose statement it is
  Span span;         ///< of the statement, or of the call in it
};

/// A cell, and whence its shapes come.
struct TracedCell {
  GrammarChunk chunk;                ///< as deriveCell gives it
  std::vector<ShapeOrigin> origins;  ///< of each of its shapes
  std::vector<std::string> uses;     ///< of rules: derivation paths, as in DeriveNote
};

/// deriveCell, for whoever asks which rule has made a shape. Takes longer and much more memory.
Result<TracedCell> traceCell(const Program& program, const ParameterValues& parameters, uint64_t world_seed,
                             uint32_t layer, Int3 cell, const LowerLayers& lower, const DeriveLimits& limits = {},
                             std::pmr::memory_resource* memory = std::pmr::get_default_resource());

/// One use of a rule, alone: the shapes derived below the call as groups that add, wherever the call stands. What
/// encloses the call (a cut, a meet, a sum, a smooth union, a displacement, a warp, a morph) is left out, but for the
/// levels that an enclosing `detail` or `lod` gives. Where the rule is a layer's start, its cuts of the domain cut the
/// other shapes; where it has nothing but such cuts, what it cuts away counts as its shapes.
struct RuleInstance {
  Int3 origin;          ///< of the frame that the rule starts with, units
  std::string path;     ///< derivation path, "net(0, 0, -1)/Node/Chamber[0]", as overrides name it
  bool bounded = true;  ///< otherwise some shape has no bound, and the chunk holds no group
  GrammarChunk chunk;   ///< with the anchors below the call that the cell owns; without notes
};

/// As deriveCell, but every use of `rule` in the cell instead of the cell as a whole; in order of derivation, those
/// within others after them. Shapes are not held to the layer's reach.
/// Errors: as deriveCell; limit also where the copies hold more than limits.shapes shapes together.
Result<std::vector<RuleInstance>> deriveInstances(const Program& program, const ParameterValues& parameters,
                                                  uint64_t world_seed, uint32_t layer, Int3 cell, uint32_t rule,
                                                  const LowerLayers& lower, const DeriveLimits& limits = {},
                                                  std::pmr::memory_resource* memory = std::pmr::get_default_resource());

}  // namespace sgm
