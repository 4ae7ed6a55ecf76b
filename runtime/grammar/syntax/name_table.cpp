#include "grammar/syntax/name_table.h"

namespace sgm {

NameId NameTable::intern(std::string_view text) {
  const auto found = ids_.find(text);
  if (found != ids_.end()) return found->second;
  const NameId id = static_cast<NameId>(ast_.names.size());
  ast_.names.emplace_back(text);
  ids_.emplace(text, id);
  return id;
}

}  // namespace sgm
