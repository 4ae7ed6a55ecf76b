#pragma once
// Global names: declarations, imports, layers.

#include <cstdint>
#include <map>
#include <vector>

#include "grammar/check/check_context.h"
#include "grammar/check/scope.h"

namespace sgm {

/// The meaning of a name at the top level of a file.
struct Symbol {
  Ref ref = Ref::none;
  uint32_t id = 0;
  bool import = false;  ///< of a file: id is its module, or kNoId if it could not be read
  Span span;
  bool asset = false;  ///< id: Program::assets
};

/// The names that each file declares, whether the layers are known, and whether a used name may be declared in a part
/// of the text that was not parsed.
class Symbols {
 public:
  using Table = std::map<NameId, Symbol>;

  explicit Symbols(CheckContext& check) : check_(check), tables_(check.syntax.size()) {}

  /// Collects the declarations of all files; reports duplicates, names of the language, and statements that only a root
  /// may have.
  void collect();

  const Table& of(uint32_t module) const { return tables_[module]; }
  /// nullptr if the module does not declare the name.
  const Symbol* find(uint32_t module, NameId name) const;

  /// Call once the layers are sorted. Before, messages about unknown layers would only follow from another error.
  void setLayersKnown() { layers_known_ = true; }
  bool areLayersKnown() const { return layers_known_; }
  /// An index into Program::layers; kNoId after an error.
  uint32_t findLayer(NameId name, const Span& span);

  /// Whether a name that is unknown in a module may be declared in a part of it that was not parsed; kNoId: a file that
  /// could not be read.
  bool mayBeLost(uint32_t module, NameId name);
  /// Records that the program may use something that was not parsed.
  void expectLoss() { uses_lost_ = true; }
  bool usesWhatIsLost() const { return uses_lost_; }

  /// Sets ref, id and qualifier of a call or a name; removes a receiver that is a module. Returns false if the receiver
  /// is a value. An unknown name is reported, and its ref stays none. shape: a call of a rule or a primitive is
  /// expected.
  bool resolveCallee(ExprId call, const Scope& scope, bool shape);

 private:
  void declare(const ModuleSyntax& module, NameId name, const Symbol& symbol);
  bool reportMissingImport(const ExprNode& receiver, const Scope& scope, bool shape);
  void reportAbsent(const ExprNode& call, NameId receiver, uint32_t module);
  void reportUnknownName(const Span& span, NameId name, const Scope& scope, bool call, bool shape);
  void reportMisusedAsset(const Span& span, NameId name);

  CheckContext& check_;
  std::vector<Table> tables_;  ///< by module
  bool layers_known_ = false;
  bool uses_lost_ = false;
};

}  // namespace sgm
