#pragma once
// The environments in which statements and expressions are derived. All objects of these types live on the stack.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/hash.h"
#include "derive/frame.h"
#include "derive/interpret/value.h"
#include "derive/shape.h"
#include "grammar/syntax/program.h"

namespace sgm::interpret {

struct Env;

/// Parallel planes to which the borders of nested splits snap. They are perpendicular to `normal`: one at the
/// coordinate `first` along the normal, the others at multiples of `distance` from it, in metres.
struct SnapPlanes {
  Vec3 normal;
  double first = 0, distance = 1;
  const SnapPlanes* outer = nullptr;
};

/// A linked list of the overrides by tag around the current statement: those whose block contains the statement,
/// innermost first. They are listed because an override does not apply to statements within its own block.
struct OwnBlock {
  uint32_t edit = 0;
  const OwnBlock* outer = nullptr;
};

/// The target of one or more overrides: the content that they replace. The statement `inner` in an override's block
/// stands for this content.
struct UnderEdit {
  /// the rule whose activation is the target, called with `arguments`; null if the target is a block
  const Rule* rule = nullptr;
  std::vector<Value>* arguments = nullptr;
  /// the tagged block that is the target; null if the target is an activation of a rule
  const StmtNode* statement = nullptr;
  const std::vector<uint32_t>& edits;  ///< the overrides that apply, in the order of Program::overrides
  size_t at = 0;                       ///< index in `edits` of the override whose block is being derived
  const Env* env = nullptr;            ///< the environment in which the target is derived
  PathKey own_key;                     ///< the key for random draws in the override's block
  /// true: the target is the block of a treemap's room; such a block also cuts the room's space from its surroundings
  bool room = false;
};

/// The environment in which a statement or an expression is derived.
struct Env {
  Placement place;
  Vec3 scope;  ///< lengths of the three edges of the scope's box, metres
  PathKey key;
  uint32_t activation = 0;  ///< index of the current activation in Activations
  uint16_t material = 0, tag = 0;
  uint32_t sweep = kNone;  ///< index of the polyline along which the expression `u` is measured; kNone: none
  /// for a cut directly inside a `detail` statement: that statement's cell edge in units; 0: none
  int32_t cut_detail = 0;
  bool anchors = true;  ///< false: the statement emits no anchors
  /// true: no shape may be left out, since an enclosing statement combines all of them into one shape
  bool whole = false;
  /// true in the layer's own activation of its start rule, where a cut removes solid from the domain
  bool top = false;
  /// values of the arguments and local variables of the current alternative or override
  std::vector<Value>* slots = nullptr;
  /// material and tag that an override sets around its `inner`; they take precedence over those of blocks; 0: none
  uint16_t forced_material = 0, forced_tag = 0;
  /// material and tag set by a block within the current override's block; 0: none
  uint16_t written_material = 0, written_tag = 0;
  const OwnBlock* within = nullptr;
  const UnderEdit* under = nullptr;
  const SnapPlanes* snaps = nullptr;
};

/// Indices of shapes in the draft.
using ShapeList = std::vector<uint32_t>;

}  // namespace sgm::interpret
