#pragma once
// Resolves global names: names of declarations, imports and layers.

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
  bool import = false;  ///< an imported file; id: its module, or kNoId if the file could not be read
  Span span;
  bool asset = false;  ///< an imported asset; id: index into Program::assets
};

/// The symbol table of each file. Also records whether the layers are known, and whether an unknown name may be
/// declared in a part of the text that failed to parse.
class Symbols {
 public:
  using Table = std::map<NameId, Symbol>;

  explicit Symbols(CheckContext& check) : check_(check), tables_(check.syntax.size()) {}

  /// Collects the declarations of all files. Reports duplicates, names that are words of the language, and declarations
  /// that only the root file may have.
  void collect();

  const Table& of(uint32_t module) const { return tables_[module]; }
  /// Returns the meaning of a name in a module; nullptr if the module does not declare the name.
  const Symbol* find(uint32_t module, NameId name) const;

  /// Must be called after the layers are sorted. If sorting fails, it is not called; then unknown layers are not
  /// reported, since they may be a consequence of that error.
  void setLayersKnown() { layers_known_ = true; }
  bool areLayersKnown() const { return layers_known_; }
  /// Returns the index of a layer in Program::layers; kNoId after reporting an error at `span`.
  uint32_t findLayer(NameId name, const Span& span);

  /// Whether an unknown name may be declared in a part of the module that failed to parse. module: kNoId stands for a
  /// file that could not be read.
  bool mayBeLost(uint32_t module, NameId name);
  /// Records that the program may use a declaration that failed to parse.
  void expectLoss() { uses_lost_ = true; }
  bool usesWhatIsLost() const { return uses_lost_; }

  /// Sets ref, id and qualifier of a call or a name. If the receiver (the part before the dot) is a module, it is
  /// removed from the node. If it is, or is taken for, a value, returns false. An unknown name is reported, and its ref
  /// stays Ref::none. shape: the context requires a call of a rule or a primitive.
  bool resolveCallee(ExprId call, const Scope& scope, bool shape);

 private:
  void declare(const ModuleSyntax& module, NameId name, const Symbol& symbol);
  bool reportMissingImport(const ExprNode& receiver, const Scope& scope, bool shape);
  void reportAbsent(const ExprNode& call, NameId receiver, uint32_t module);
  void reportUnknownName(const Span& span, NameId name, const Scope& scope, bool call, bool shape);
  void reportMisusedAsset(const Span& span, NameId name);

  CheckContext& check_;
  std::vector<Table> tables_;  ///< the symbol table of each file, by module index
  bool layers_known_ = false;
  bool uses_lost_ = false;
};

}  // namespace sgm
