#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "grammar/syntax/ast.h"

namespace sgm {

/// Interns the names of one program: equal texts get equal ids.
class NameTable {
 public:
  explicit NameTable(Ast& ast) : ast_(ast) {}
  NameId intern(std::string_view text);

 private:
  Ast& ast_;
  std::map<std::string, NameId, std::less<>> ids_;
};

}  // namespace sgm
