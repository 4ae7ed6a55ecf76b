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

/// Planes to which the borders of nested splits snap. They are perpendicular to `normal`; the first is at coordinate
/// `first`, the others follow every `distance` metres.
struct SnapPlanes {
  Vec3 normal;
  double first = 0, distance = 1;
  const SnapPlanes* outer = nullptr;
};

/// A linked list of the overrides by tag whose block contains the current statement, innermost first. They do not apply
/// again within their own block.
struct OwnBlock {
  uint32_t edit = 0;
  const OwnBlock* outer = nullptr;
};

/// A target of overrides. While an override's block is derived, the target is the content for which `inner` stands.
struct UnderEdit {
  const Rule* rule = nullptr;  ///< if the target is an activation of a rule: the rule; `arguments` are its arguments
  std::vector<Value>* arguments = nullptr;
  const StmtNode* statement = nullptr;  ///< if the target is a block with a tag: the block
  const std::vector<uint32_t>& edits;   ///< the overrides that apply, in the order of Program::overrides
  size_t at = 0;                        ///< index in `edits` of the override whose block is being derived
  const Env* env = nullptr;             ///< the environment in which the target is derived
  PathKey own_key;                      ///< the key of the override's block
  /// the block belongs to a room of a treemap, and also cuts the room's space from its surroundings
  bool room = false;
};

/// The environment of a statement or an expression.
struct Env {
  Placement place;
  Vec3 scope;  ///< edges of the scope's box, metres
  PathKey key;
  uint32_t activation = 0;  ///< index in Activations
  uint16_t material = 0, tag = 0;
  uint32_t sweep = kNone;  ///< the polyline along which `u` is measured; kNone: none
  int32_t cut_detail = 0;  ///< if a `detail` directly encloses a cut: its cell edge in units; 0: none
  bool anchors = true;     ///< false: anchors are not emitted here
  bool whole = false;  ///< no shape may be left out, since an enclosing statement combines all of them into one shape
  bool top = false;    ///< in the layer's own activation of its start rule, where a cut removes from the domain
  std::vector<Value>* slots = nullptr;  ///< values of the current frame's slots
  /// labels set by an override around `inner`, which take precedence over those of blocks; 0: none
  uint16_t forced_material = 0, forced_tag = 0;
  /// labels set by a block within the current override's block; 0: none
  uint16_t written_material = 0, written_tag = 0;
  const OwnBlock* within = nullptr;
  const UnderEdit* under = nullptr;
  const SnapPlanes* snaps = nullptr;
};

/// Indices of shapes in the draft.
using ShapeList = std::vector<uint32_t>;

}  // namespace sgm::interpret
