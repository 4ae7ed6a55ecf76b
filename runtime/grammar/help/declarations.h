#pragma once
// The declarations of a text and the scopes of its names, for editors: from the tokens alone, so that it also works for
// a text with errors that is being edited. Pure.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sgm {

enum class NameKind : uint8_t { import, parameter, let, field, rule, morphic, layer, local };

/// The keyword of the kind, as written before a name: "param", "rule".
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
  TextRange at;      ///< of the name itself
  TextRange whole;   ///< of the declaration; for a local: of its name
  TextRange known;   ///< the scope of the name: a rule for locals, otherwise all the text
  std::string head;  ///< the declaration up to its block or value, on one line
  std::string doc;   ///< a parameter's text; otherwise the comment directly above
  std::string path;  ///< of an import
};

struct Declarations {
  std::vector<DeclaredName> names;  ///< in the order of the text; each head of a rule is one

  /// The meanings of a name at a place: a local, or all declarations of the text with this name.
  std::vector<const DeclaredName*> find(std::string_view name, uint32_t offset) const;
};

/// Accepts any text; never fails.
Declarations declarationsOf(std::string_view text);

/// The word that contains or precedes the offset, and its qualifier.
struct WordAt {
  TextRange at;
  std::string word;
  std::string qualifier;  ///< `rock` of rock.fbm, `cell` of cell.point
  bool behind_dot = false;
};
/// nullopt in comments and text constants. If there is no word, returns an empty one.
std::optional<WordAt> wordAt(std::string_view text, uint32_t offset);

}  // namespace sgm
