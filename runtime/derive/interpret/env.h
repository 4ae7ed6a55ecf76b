#pragma once
// The surroundings in which statements and expressions are derived. All of it lives on the stack.

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

/// Planes to which the lines of nested splits snap: across `normal`, every `distance` metres of the cell from `first`.
struct SnapPlanes {
  Vec3 normal;
  double first = 0, distance = 1;
  const SnapPlanes* outer = nullptr;
};

/// The overrides by tag whose own block contains the current statement.
struct OwnBlock {
  uint32_t edit = 0;
  const OwnBlock* outer = nullptr;
};

/// The target of overrides; for an override's block, the content that its `inner` derives.
struct UnderEdit {
  const Rule* rule = nullptr;  ///< an activation of it, with these arguments
  std::vector<Value>* arguments = nullptr;
  const StmtNode* statement = nullptr;  ///< or a block with a tag
  const std::vector<uint32_t>& edits;   ///< that apply, as in Program::overrides
  size_t at = 0;                        ///< the current override, an index into `edits`
  const Env* env = nullptr;             ///< the environment of the target
  PathKey own_key;                      ///< of the block
  bool room = false;                    ///< the block belongs to a room, to which it adds and from which it cuts
};

/// The environment of a statement or an expression.
struct Env {
  Placement place;
  Vec3 scope;  ///< edges of the scope's box, metres
  PathKey key;
  uint32_t activation = 0;
  uint16_t material = 0, tag = 0;
  uint32_t sweep = kNone;  ///< the polyline that is the domain of `u`
  int32_t cut_detail = 0;  ///< of a `detail` directly before a cut
  bool anchors = true;
  bool whole = false;  ///< no part may be left out: an enclosing statement makes one shape of all of them
  bool top = false;    ///< the layer's own activation of its start rule, in which a cut removes from the domain
  std::vector<Value>* slots = nullptr;
  uint16_t forced_material = 0, forced_tag = 0;    ///< of an override around `inner`: take precedence over a block's
  uint16_t written_material = 0, written_tag = 0;  ///< set by a block since the override's began
  const OwnBlock* within = nullptr;
  const UnderEdit* under = nullptr;
  const SnapPlanes* snaps = nullptr;
};

/// Indices of shapes in the draft.
using ShapeList = std::vector<uint32_t>;

}  // namespace sgm::interpret
