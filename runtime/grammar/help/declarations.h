#pragma once
// Finds the declarations in a text and the scopes of their names, for editors. Uses only tokens, without parsing, so
// that it also works while a text is being edited and has errors. Pure functions.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sgm {

enum class NameKind : uint8_t { import, parameter, let, field, rule, morphic, layer, local };

/// The keyword that introduces a declaration of this kind: "param", "rule".
std::string_view nameKindText(NameKind kind);

/// A range of bytes in a text.
struct TextRange {
  uint32_t begin = 0, end = 0;
  bool holds(uint32_t offset) const { return offset >= begin && offset <= end; }
  friend bool operator==(const TextRange&, const TextRange&) = default;
};

struct DeclaredName {
  NameKind kind = NameKind::local;
  std::string name;
  TextRange at;      ///< range of the name itself in the text
  TextRange whole;   ///< range of the whole declaration; for a local: the same as `at`
  TextRange known;   ///< the scope of the name: the enclosing rule for locals, otherwise the whole text
  std::string head;  ///< the declaration up to its block or value, on one line
  std::string doc;   ///< the text constant of a `param`; otherwise the comment directly above the declaration
  std::string path;  ///< for an import: the path of the imported file
};

struct Declarations {
  std::vector<DeclaredName> names;  ///< in the order of the text; each head of a rule is a separate entry

  /// Finds the declarations that `name` may refer to at this byte offset: a local if one is in scope, otherwise all
  /// global declarations of that name.
  std::vector<const DeclaredName*> find(std::string_view name, uint32_t offset) const;
};

/// Accepts any text; never fails.
Declarations declarationsOf(std::string_view text);

/// The word at or directly before a byte offset, and the qualifier in front of it.
struct WordAt {
  TextRange at;
  std::string word;
  std::string qualifier;  ///< the word before the dot: `rock` in rock.fbm, `cell` in cell.point
  bool behind_dot = false;
};
/// Returns nullopt within comments and text constants, and an empty word if there is none at the offset.
std::optional<WordAt> wordAt(std::string_view text, uint32_t offset);

}  // namespace sgm
