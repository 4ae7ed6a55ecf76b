#pragma once
// What a text declares and where its names are known, for editors: from the tokens alone, so that it is there while
// the text is being written and is wrong in many places. Pure.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sgm {

enum class NameKind : uint8_t { import, parameter, let, field, rule, morphic, layer, local };

/// The word of the kind, as it stands before a name: "param", "rule".
std::string_view nameKindText(NameKind kind);

/// Bytes of a text.
struct TextRange {
  uint32_t begin = 0, end = 0;
  bool holds(uint32_t offset) const { return offset >= begin && offset <= end; }
  friend bool operator==(const TextRange&, const TextRange&) = default;
};

struct DeclaredName {
  NameKind kind = NameKind::local;
  std::string name;
  TextRange at;      ///< of the name itself
  TextRange whole;   ///< of the declaration; of a local: of its name
  TextRange known;   ///< where the name means this: of locals a rule, otherwise all the text
  std::string head;  ///< the declaration up to its block or value, on one line
  std::string doc;   ///< of a parameter its text; otherwise the comment right above
  std::string path;  ///< of an import
};

struct Declarations {
  std::vector<DeclaredName> names;  ///< in the order of the text; each head of a rule is one

  /// What a name means at a place: a local, or all that the text declares with this name.
  std::vector<const DeclaredName*> find(std::string_view name, uint32_t offset) const;
};

/// Any text; never fails.
Declarations declarationsOf(std::string_view text);

/// The word that the offset lies in or behind, and what it belongs to.
struct WordAt {
  TextRange at;
  std::string word;
  std::string qualifier;  ///< `rock` of rock.fbm, `cell` of cell.point
  bool behind_dot = false;
};
/// Nothing in comments and text constants. Where no word stands there, an empty one.
std::optional<WordAt> wordAt(std::string_view text, uint32_t offset);

}  // namespace sgm
