// Checks the statement wfc: the labels of its tiles, and whether every side fits some other side.

#include <algorithm>
#include <array>

#include "grammar/check/leaf_statements.h"
#include "grammar/check/type_rules.h"
#include "grammar/syntax/keywords.h"
#include "grammar/syntax/scope_parts.h"
#include "grammar/text/codes.h"

namespace sgm {

namespace {

constexpr size_t kSides = 6;
constexpr size_t kUpright = 4;

size_t opposite(size_t side) { return side < kUpright ? (side + 2) % kUpright : 9 - side; }

/// True if a socket of a tile applies to this side. A socket of BoxPart::side applies to all upright sides.
bool saysSide(const SocketNode& socket, size_t side) {
  return static_cast<size_t>(socket.of) == side || (socket.of == BoxPart::side && side < kUpright);
}

void checkTileSize(CheckContext& check, Types& types, ExprId size) {
  const Type type = types.checkExpression(size);
  const bool vector = type.kind == ValueKind::vector;
  types.requireType(size, type, vector ? ValueKind::vector : ValueKind::number, kLength, "the size of a tile");
  if (!agrees(type, ValueKind::number, kLength) && !agrees(type, ValueKind::vector, kLength)) return;
  const IdRange parts = check.node(size).kind == ExprKind::vector ? check.node(size).children : IdRange{};
  for (uint32_t i = 0; i < std::max(1u, parts.count); ++i) {
    const ExprId edge = parts.count == 0 ? size : check.program.idAt(parts, i);
    if (!vector || parts.count > 0) types.judgeRange(edge, kTileRange);
  }
}

/// Assigns bits to the labels of a wfc, and indices to the distinct kinds of sides.
void numberSides(CheckContext& check, const StmtNode& s) {
  std::vector<uint32_t> labels;
  std::vector<SideKind> kinds;
  const auto bitsOf = [&](IdRange names) {
    uint64_t bits = 0;
    for (uint32_t i = 0; i < names.count; ++i) {
      const auto known = std::find(labels.begin(), labels.end(), check.program.idAt(names, i));
      const size_t bit = static_cast<size_t>(known - labels.begin());
      if (known == labels.end()) labels.push_back(check.program.idAt(names, i));
      if (bit < kMaxLabels) bits |= uint64_t{1} << bit;
    }
    return bits;
  };
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    TileNode& tile = check.program.ast.tiles[check.program.ast.parts[s.parts.first + i].tile];
    for (size_t side = 0; side < kSides; ++side) {
      const SocketNode* says = nullptr;
      for (uint32_t k = 0; k < tile.sockets.count; ++k) {
        const SocketNode& socket = check.program.ast.sockets[tile.sockets.first + k];
        if (saysSide(socket, side) && (says == nullptr || says->of == BoxPart::side)) says = &socket;
      }
      SideKind kind;
      if (says != nullptr) {
        kind.labels = bitsOf(says->labels);
        kind.meets = says->meets.count > 0 ? bitsOf(says->meets) : kind.labels;
      }
      const auto known = std::find(kinds.begin(), kinds.end(), kind);
      tile.sides[side] = static_cast<uint8_t>(std::min<size_t>(static_cast<size_t>(known - kinds.begin()), 255));
      if (known == kinds.end()) kinds.push_back(kind);
    }
  }
  if (labels.size() > kMaxLabels)
    check.sink.error(s.span, codes::kArgumentCount, "the sides of a wfc have at most 63 labels",
                     "give sides that meet the same ones one label");
  else if (kinds.size() > kMaxSideKinds)
    check.sink.error(s.span, codes::kArgumentCount, "a wfc has at most 64 kinds of sides: of labels and what they meet",
                     "give sides that meet the same ones the same labels");
  WaveNode& wave = check.program.ast.waves[s.extra];
  wave.labels = check.store(labels);
  wave.kinds = {static_cast<uint32_t>(check.program.ast.side_kinds.size()), static_cast<uint32_t>(kinds.size())};
  check.program.ast.side_kinds.insert(check.program.ast.side_kinds.end(), kinds.begin(), kinds.end());
}

std::string labelsText(const Program& program, IdRange labels) {
  std::string out;
  for (uint32_t i = 0; i < labels.count; ++i)
    out += join({i == 0 ? "`" : " or `", program.text(program.idAt(labels, i)), "`"});
  return out;
}

/// Reports a label that this side requires of its neighbour, but that no tile has on the opposite side. there: the
/// labels that do occur on opposite sides; the author may have meant one of them.
void reportUnmet(CheckContext& check, const PartNode& part, const SocketNode& socket, size_t side, uint64_t there,
                 const WaveNode& wave) {
  const IdRange meets = socket.meets.count > 0 ? socket.meets : socket.labels;
  const std::string wanted = labelsText(check.program, meets);
  Suggestion suggestion(check.text(check.program.idAt(meets, 0)));
  for (uint32_t l = 0; l < wave.labels.count; ++l)
    if ((there >> l & 1) != 0) suggestion.offer(check.text(check.program.idAt(wave.labels, l)));
  const std::string_view word = boxPartTable()[side], across = boxPartTable()[opposite(side)];
  const std::string also =
      socket.meets.count > 0 ? join({", and let it meet ", labelsText(check.program, socket.labels)}) : "";
  if (part.label == kNoId)
    check.sink.error(socket.span, codes::kUnknownName,
                     join({"no tile has ", wanted, " on its ", word, ", as this border requires"}),
                     suggestion.hintOr(join({"give a tile that label there", also})));
  else
    check.sink.error(socket.span, codes::kUnknownName,
                     join({"nothing has ", wanted, " to meet the ", word, " of `", check.text(part.label), "`"}),
                     suggestion.hintOr(join({"give it to the ", across, " of a tile, or to the border", also})));
}

/// Reports each written side whose labels match no side of any tile, in any rotation, or of the border; such labels are
/// probably misspelt.
void checkAnswers(CheckContext& check, const StmtNode& s) {
  if (check.sink.errorCount() > 0) return;
  const WaveNode& wave = check.program.ast.waves[s.extra];
  const SideKind* kinds = check.program.ast.side_kinds.data() + wave.kinds.first;
  const auto turnsOf = [](const TileNode& tile, size_t side) { return tile.turns && side < kUpright ? kUpright : 1; };
  const auto turned = [](size_t side, size_t turn) { return side < kUpright ? (side + turn) % kUpright : side; };
  // A side of the border without labels matches the side of every tile. It is not collected here, since it would make
  // every label of a tile count as matched, although most tiles do not lie at the border.
  std::array<std::vector<SideKind>, kSides> tiles, border;
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const PartNode& part = check.program.ast.parts[s.parts.first + i];
    const TileNode& tile = check.program.ast.tiles[part.tile];
    for (size_t side = 0; side < kSides; ++side) {
      const SideKind& kind = kinds[tile.sides[side]];
      if (part.label == kNoId && !kind.any()) border[side].push_back(kind);
      for (size_t turn = 0; part.label != kNoId && turn < turnsOf(tile, side); ++turn)
        tiles[turned(side, turn)].push_back(kind);
    }
  }
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const PartNode& part = check.program.ast.parts[s.parts.first + i];
    const TileNode& tile = check.program.ast.tiles[part.tile];
    for (uint32_t k = 0; k < tile.sockets.count; ++k) {
      const SocketNode& socket = check.program.ast.sockets[tile.sockets.first + k];
      for (size_t side = 0; side < kSides; ++side) {
        const SideKind& kind = kinds[tile.sides[side]];
        if (!saysSide(socket, side)) continue;
        uint64_t there = 0;
        bool met = false;
        const auto ask = [&](const std::vector<SideKind>& others) {
          for (const SideKind& other : others) {
            met = met || kind.fits(other);
            if (!other.any()) there |= other.labels;
          }
        };
        if (part.label == kNoId) ask(tiles[side]);
        for (size_t turn = 0; part.label != kNoId && turn < turnsOf(tile, side); ++turn) {
          ask(tiles[opposite(turned(side, turn))]);
          ask(border[turned(side, turn)]);
        }
        if (met) continue;
        reportUnmet(check, part, socket, side, there & ~kind.meets, wave);
        break;
      }
    }
  }
}

}  // namespace

void checkTiles(CheckContext& check, Types& types, const StmtNode& s) {
  checkTileSize(check, types, s.expr);
  std::vector<NameId> tiles;
  int borders = 0;
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const PartNode& part = check.program.ast.parts[s.parts.first + i];
    if (part.label == kNoId) {
      if (borders++ > 0)
        check.sink.error(part.span, codes::kDuplicate, "this wfc has a second border",
                         "put its sides into the first one, with a `,` between them");
      continue;
    }
    types.requireRange(part.size, kRatio, "the weight of a tile", kTileWeightRange);
    if (std::find(tiles.begin(), tiles.end(), part.label) != tiles.end())
      check.sink.error(part.span, codes::kDuplicate,
                       join({"this wfc has a second tile `", check.text(part.label), "`"}),
                       "give each tile a name of its own");
    tiles.push_back(part.label);
  }
  if ((tiles.empty() && !check.isLossy(s)) || tiles.size() > kMaxTiles)
    check.sink.error(s.span, codes::kArgumentCount, "a wfc has 1 to 64 tiles",
                     "such as `wall 3 turn, left brick, right brick: Wall;`");
  numberSides(check, s);
  checkAnswers(check, s);
}

}  // namespace sgm
