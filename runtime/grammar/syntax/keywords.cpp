#include "grammar/syntax/keywords.h"

#include <algorithm>
#include <array>

#include "grammar/syntax/ast.h"

namespace sgm {

namespace {

/// Reserved words that do not start a statement.
constexpr std::array<std::string_view, 33> kOtherKeywords = {
    "and",    "as",    "at",   "by",      "depth",  "domain",  "else",  "expect", "false",    "if",    "import",
    "in",     "layer", "lod",  "minsize", "mirror", "morphic", "not",   "or",     "override", "param", "query",
    "report", "rot",   "rule", "scale",   "seed",   "size",    "start", "then",   "true",     "units", "when"};
constexpr std::array<std::string_view, 54> kClauseWords = {
    "above",    "air",     "amp",    "animated", "axes",    "block",   "border", "box",    "cell",   "clear", "cm",
    "corridor", "density", "disc",   "door",     "down",    "edge",    "empty",  "facade", "finite", "flat",  "from",
    "gable",    "gap",     "hip",    "infinite", "inside",  "km",      "lerp",   "m",      "meets",  "merge", "mm",
    "of",       "on",      "output", "per",      "poisson", "polygon", "power",  "probe",  "reach",  "rect",  "regular",
    "sgm",      "shell",   "smooth", "solid",    "stretch", "turn",    "up",     "uses",   "weight", "within"};
constexpr std::array<std::string_view, 2> kUnavailable = {"portal", "set"};
constexpr std::array<std::string_view, 14> kDeclarations = {"import",  "units",    "param",  "seed",  "let",
                                                            "field",   "domain",   "layer",  "start", "rule",
                                                            "morphic", "override", "report", "expect"};
constexpr std::array<std::string_view, 5> kTransforms = {"at", "rot", "scale", "size", "mirror"};
constexpr std::array<std::string_view, 7> kMeasures = {"watertight", "components", "volume", "area",
                                                       "triangles",  "genus",      "anchors"};

constexpr std::array<std::string_view, 9> kBoxParts = {"front",  "right", "back",  "left",  "top",
                                                       "bottom", "side",  "edges", "inside"};

/// Whether the word that starts a statement is reserved; if not, it is a clause word.
constexpr bool isReserved(std::string_view statement_word) {
  return !statement_word.empty() &&
         std::find(kClauseWords.begin(), kClauseWords.end(), statement_word) == kClauseWords.end();
}

constexpr size_t kReservedStatements = static_cast<size_t>(
    std::count_if(kStmtInfos.begin(), kStmtInfos.end(), [](const StmtInfo& info) { return isReserved(info.word); }));

/// All reserved words, sorted: the words that start statements, and the other keywords.
constexpr auto kKeywords = [] {
  std::array<std::string_view, kReservedStatements + kOtherKeywords.size()> words;
  auto next = std::copy(kOtherKeywords.begin(), kOtherKeywords.end(), words.begin());
  for (const StmtInfo& info : kStmtInfos)
    if (isReserved(info.word)) *next++ = info.word;
  std::sort(words.begin(), words.end());
  return words;
}();

static_assert(std::is_sorted(kOtherKeywords.begin(), kOtherKeywords.end()));
static_assert(std::adjacent_find(kKeywords.begin(), kKeywords.end()) == kKeywords.end());
static_assert(std::is_sorted(kClauseWords.begin(), kClauseWords.end()));
static_assert(std::is_sorted(kUnavailable.begin(), kUnavailable.end()));

}  // namespace

std::span<const std::string_view> keywordTable() { return kKeywords; }
std::span<const std::string_view> clauseWordTable() { return kClauseWords; }
std::span<const std::string_view> unavailableTable() { return kUnavailable; }
std::span<const std::string_view> declarationTable() { return kDeclarations; }
std::span<const std::string_view> transformTable() { return kTransforms; }
std::span<const std::string_view> measureTable() { return kMeasures; }
std::span<const std::string_view> boxPartTable() { return kBoxParts; }

bool isValueWord(std::string_view word) {
  return word == "cell" || word == "scope" || word == "p" || word == "q" || word == "u";
}
bool isKeyword(std::string_view word) { return std::binary_search(kKeywords.begin(), kKeywords.end(), word); }
bool startsDeclaration(std::string_view word) {
  return std::find(kDeclarations.begin(), kDeclarations.end(), word) != kDeclarations.end();
}
bool isUnavailable(std::string_view word) { return std::binary_search(kUnavailable.begin(), kUnavailable.end(), word); }

}  // namespace sgm
