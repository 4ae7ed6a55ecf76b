#pragma once
// The names that are visible at one place of a rule, a let or a field.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "grammar/check/rule_uses.h"
#include "grammar/syntax/ast.h"

namespace sgm {

/// A parameter, or a name declared by a statement.
struct Local {
  NameId name = kNoId;
  uint32_t slot = 0;  ///< index of the name's value in the frame
  Type type;
  uint32_t field = kNoId;  ///< index into Program::fields if this names a local field; kNoId: it names a value
  size_t depth = 0;  ///< for a local field: the number of locals declared before it, which are visible in its body
};

/// The context in which an expression is checked.
struct Scope {
  uint32_t module = 0;
  bool field = false;  ///< the checked expression is the body of a field
  std::vector<Local> locals;
  uint32_t next_slot = 0;
  uint32_t slot_count = 0;
  uint32_t* draws = nullptr;                 ///< counter that is increased by each call of rand or chance; null: these
                                             ///< calls are not counted
  std::vector<AskedLayer>* asked = nullptr;  ///< receives the layers that the checked expression probes or queries;
                                             ///< null outside of rules and overrides

  /// Whether the checked expression is in a rule or an override: `cell` and `scope` are defined, and `rand` needs no
  /// key.
  bool inRule() const { return asked != nullptr; }
  /// Whether a local has this name, and hides outer declarations of it.
  bool hides(NameId name) const {
    return std::any_of(locals.begin(), locals.end(), [name](const Local& local) { return local.name == name; });
  }
  /// Ends a block: keeps the first `count` locals, which were declared before the block, and removes all others.
  void closeTo(size_t count) { locals.resize(std::min(count, locals.size())); }
};

}  // namespace sgm
