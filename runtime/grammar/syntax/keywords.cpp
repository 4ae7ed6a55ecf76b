#include "grammar/syntax/keywords.h"

#include <algorithm>
#include <array>

namespace sgm {

namespace {

constexpr std::array<std::string_view, 60> kKeywords = {
    "anchor", "and",   "as",      "at",      "by",      "comp",     "cut",   "depth",     "detail", "displace",
    "domain", "else",  "expect",  "extrude", "false",   "field",    "fit",   "footprint", "for",    "if",
    "import", "in",    "inner",   "layer",   "let",     "link",     "lod",   "mat",       "meet",   "minsize",
    "mirror", "morph", "morphic", "not",     "or",      "override", "param", "query",     "repeat", "report",
    "roof",   "rot",   "rule",    "scale",   "scatter", "seed",     "size",  "snap",      "split",  "start",
    "sum",    "tag",   "then",    "treemap", "true",    "union",    "units", "warp",      "wfc",    "when"};
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

static_assert(std::is_sorted(kKeywords.begin(), kKeywords.end()));
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
