#pragma once
// The names that are known at one place of a rule, a let or a field.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "grammar/check/rule_uses.h"
#include "grammar/syntax/ast.h"

namespace sgm {

/// A parameter, or a name that a statement declares.
struct Local {
  NameId name = kNoId;
  uint32_t slot = 0;
  Type type;
  uint32_t field = kNoId;  ///< a local field instead of a value: Program::fields
  size_t depth = 0;        ///< for a field: the number of locals before it
};

/// The surroundings of an expression.
struct Scope {
  uint32_t module = 0;
  bool field = false;  ///< in the body of a field
  std::vector<Local> locals;
  uint32_t next_slot = 0;
  uint32_t slot_count = 0;
  uint32_t* draws = nullptr;                 ///< the counter of rand and chance; null: draws are not counted
  std::vector<AskedLayer>* asked = nullptr;  ///< receives probes and queries; null outside of rules and overrides

  /// Whether cell and scope are known, and rand needs no key.
  bool inRule() const { return asked != nullptr; }
  /// Whether a local has this name, and hides outer declarations of it.
  bool hides(NameId name) const {
    return std::any_of(locals.begin(), locals.end(), [name](const Local& local) { return local.name == name; });
  }
  /// Ends the names declared since there were `count` of them.
  void closeTo(size_t count) { locals.resize(std::min(count, locals.size())); }
};

}  // namespace sgm
