// Derives the statement `wfc` (wave function collapse), which fills a lattice with tiles. The box of its scope is
// centred on the scope's origin.

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/math.h"
#include "derive/draws.h"
#include "derive/interpret/statements.h"
#include "derive/layout/wave_collapse.h"
#include "grammar/syntax/keywords.h"
#include "grammar/syntax/scope_parts.h"

namespace sgm::interpret {
namespace {

/// All tiles of a wfc in all their orientations. stands: for each element of `tiles`, the index of the wfc's part that
/// it comes from, and its rotation about y in quarter turns.
struct StandingTiles {
  struct Stand {
    uint32_t part;
    int quarters;
  };
  std::vector<WaveTile> tiles;
  std::vector<Stand> stands;
};

/// Weights are scaled so that the heaviest tile has the weight kFullWeight.
constexpr double kFullWeight = 1 << 20;
/// A search for tiles may make at most kMaxVisits * (places + kMaxVisits) visits of places.
constexpr uint64_t kMaxVisits = 128;
/// The visits of a search are also limited to 1 / kSearchShare of DeriveLimits::steps. kVisitsOfStep units of the
/// search's work count as one step of the cell.
constexpr uint64_t kSearchShare = 8, kVisitsOfStep = 16;

/// The interval along an edge of the scope that one place of the lattice occupies, in metres. It overlaps the intervals
/// of the neighbouring places, as parts of a split do.
struct Stretch {
  double low, high;
};

Stretch stretchOf(double edge, uint32_t count, uint32_t at) {
  const double step = edge / count, from = -0.5 * edge;
  const double over = std::min(kSeamOverlap, step);
  return {at == 0 ? from : from + at * step - over, at + 1 == count ? 0.5 * edge : from + (at + 1) * step + over};
}

/// True if a side is a high side: front, right or top. collapseWave() lets two sides touch if they have a label in
/// common. So a high side gets its own kind as its only label; a low side gets all kinds that match its kind.
constexpr bool isHigh(size_t side) { return side < 2 || side == 4; }

std::span<const SideKind> sideKinds(const Program& program, const StmtNode& s) {
  const IdRange kinds = program.ast.waves[s.extra].kinds;
  return {&program.ast.side_kinds[kinds.first], kinds.count};
}

WaveLabels kindsThatFit(std::span<const SideKind> kinds, size_t kind) {
  WaveLabels out = 0;
  for (size_t k = 0; k < kinds.size(); ++k)
    if (kinds[k].fits(kinds[kind])) out |= WaveLabels{1} << k;
  return out;
}

WaveLabels sideLabels(std::span<const SideKind> kinds, size_t kind, bool high) {
  return high ? WaveLabels{1} << kind : kindsThatFit(kinds, kind);
}

void noteNoTiles(const StmtNode& s, const StandingTiles& standing, const WaveLattice& lattice, const WaveResult& result,
                 CellContext& c, const Env& env) {
  const auto triple = [](uint32_t x, uint32_t y, uint32_t z) {
    return "(" + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) + ")";
  };
  const auto& n = lattice.size;
  if (result.place == kNoPlace)
    return c.budget.note(
        "to fill the " + triple(n[0], n[1], n[2]) +
            " places of this scope takes too long, and it is left empty: use larger tiles, or a smaller scope",
        s.span, env.activation);
  const WaveNode& node = c.program.ast.waves[s.extra];
  const std::span<const SideKind> kinds = sideKinds(c.program, s);
  std::string met;
  for (size_t side = 0; side < kWaveSides; ++side) {
    WaveLabels fit = result.wanted[side];
    if (!isHigh(side)) {
      fit = 0;
      for (size_t k = 0; k < kinds.size(); ++k)
        if ((result.wanted[side] >> k & 1) != 0) fit |= kindsThatFit(kinds, k);
    }
    // Skips a side at which every tile matches: such a side does not explain the failure.
    if (std::all_of(standing.tiles.begin(), standing.tiles.end(),
                    [&](const WaveTile& tile) { return (tile.sides[side] & result.wanted[side]) != 0; }))
      continue;
    uint64_t labels = 0;
    for (size_t k = 0; k < kinds.size(); ++k)
      if ((fit >> k & 1) != 0 && !kinds[k].any()) labels |= kinds[k].labels;
    std::string names;
    for (uint32_t l = 0; l < node.labels.count; ++l)
      if ((labels >> l & 1) != 0)
        names +=
            std::string(names.empty() ? "`" : " or `").append(c.program.text(c.program.idAt(node.labels, l))) + '`';
    met += std::string(met.empty() ? "" : " and ").append(names).append(" on its ").append(boxPartTable()[side]);
  }
  const std::string place = triple(result.place % n[0], result.place / n[0] % n[1], result.place / n[0] / n[1]);
  c.budget.note((result.end == WaveEnd::impossible ? "these tiles cannot fill the " : "no way was found to fill the ") +
                    triple(n[0], n[1], n[2]) + " places of this scope, and it is left empty: place " + place +
                    " would need a tile with " + met + "; add one, or join labels of a side with `or`",
                s.span, env.activation);
}

/// Computes the size and the border labels of the lattice. Returns false, with a note, if the scope has no room for a
/// tile.
bool waveLattice(const StmtNode& s, CellContext& c, const Env& env, WaveLattice& lattice) {
  const Vec3 edges = env.scope;
  const Value size = c.evaluator.evaluate(s.expr, env);
  const Vec3 wanted = size.kind == ValueKind::vector ? size.vec() : Vec3{size.real(), size.real(), size.real()};
  if (c.budget.failed()) return false;
  const auto nothing = [&](const std::string& why) {
    c.budget.note(why, s.span, env.activation);
    return false;
  };
  double places = 1;
  bool sound = std::max({edges.x, edges.y, edges.z}) > 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!kTileRange.holds(wanted[axis]))
      return nothing(std::string(kTileRange.rule).append(", ").append(kTileRange.example) + "; these are left out");
    const double count = std::max(1.0, detFloor(edges[axis] / wanted[axis] + 0.5));
    sound = sound && edges[axis] >= 0 && std::isfinite(edges[axis]);
    places *= count;
    if (sound && places <= kMaxPlaces) lattice.size[static_cast<size_t>(axis)] = static_cast<uint32_t>(count);
  }
  if (!sound)
    return nothing("this scope's box has no size, so it gets no tiles: give it one, such as size(12m, 3m, 12m)");
  if (places > kMaxPlaces)
    return nothing(
        "this scope has room for more than 32768 tiles; they are left out: use larger tiles, or a smaller scope");
  lattice.border.fill(~WaveLabels{0});
  const std::span<const SideKind> kinds = sideKinds(c.program, s);
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const PartNode& part = c.program.ast.parts[s.parts.first + i];
    // The labels of a border are those of imaginary tiles just outside the lattice. Each such tile touches the lattice
    // with its opposite side: at the front border, the tile's back side touches the lattice.
    for (size_t side = 0; part.label == kNoId && side < kWaveSides; ++side)
      lattice.border[side] = sideLabels(kinds, c.program.ast.tiles[part.tile].sides[side], !isHigh(side));
  }
  return true;
}

/// Collects the tiles of the wfc in all their orientations. Returns false, with a note, if there are no tiles.
bool waveTiles(const StmtNode& s, CellContext& c, const Env& env, StandingTiles& out) {
  std::vector<double> weights(s.parts.count, 0);
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    const PartNode& part = c.program.ast.parts[s.parts.first + i];
    if (part.label == kNoId) continue;
    weights[i] = c.evaluator.real(part.size, env);
    if (c.budget.failed()) return false;
    if (kTileWeightRange.holds(weights[i])) continue;
    weights[i] = 0;
    c.budget.note(
        std::string(kTileWeightRange.rule).append(", ").append(kTileWeightRange.example).append("; this one is 0"),
        part.span, env.activation);
  }
  const double heaviest = *std::max_element(weights.begin(), weights.end());
  if (!(heaviest > 0)) {
    c.budget.note("no tile of this wfc has a weight above 0, and its scope is left empty: give one a weight", s.span,
                  env.activation);
    return false;
  }
  const std::span<const SideKind> kinds = sideKinds(c.program, s);
  for (uint32_t i = 0; i < s.parts.count; ++i) {
    if (!(weights[i] > 0)) continue;
    const TileNode& tile = c.program.ast.tiles[c.program.ast.parts[s.parts.first + i].tile];
    WaveTile stand;
    stand.weight = static_cast<uint32_t>(std::max(1.0, detFloor(weights[i] / heaviest * kFullWeight + 0.5)));
    for (int quarters = 0; quarters < (tile.turns ? 4 : 1); ++quarters) {
      // A quarter turn moves the front side to the right.
      for (size_t side = 0; side < kWaveSides; ++side) {
        const size_t outwards = side < 4 ? (side + static_cast<size_t>(quarters)) % 4 : side;
        stand.sides[outwards] = sideLabels(kinds, tile.sides[side], isHigh(outwards));
      }
      out.tiles.push_back(stand);
      out.stands.push_back({i, quarters});
    }
  }
  return true;
}

}  // namespace

void runWfc(const StmtNode& s, CellContext& c, const Env& env, ShapeList& out) {
  const Vec3 edges = env.scope;
  WaveLattice lattice;
  StandingTiles standing;
  if (!waveLattice(s, c, env, lattice) || !waveTiles(s, c, env, standing)) return;
  // The limit of visits does not depend on the remaining steps of the cell; otherwise other content of the cell would
  // change the tiles.
  const uint64_t places = uint64_t{lattice.size[0]} * lattice.size[1] * lattice.size[2];
  const uint64_t most = std::min(kMaxVisits * (places + kMaxVisits), c.in.limits.steps / kSearchShare);
  const PathKey key = env.key.child(kWaveSalt + s.ordinal, 0);
  const WaveResult result = collapseWave(standing.tiles, lattice, key.value, most, c.in.limits.bytes);
  // A unit of work counts as only a fraction of a step. So a cell rarely exceeds its limit of steps, which would fail
  // the whole cell, even if the searches of a hundred scopes find no tiles.
  if (!c.budget.step(result.work / kVisitsOfStep, s.span, env.activation)) return;
  if (result.end != WaveEnd::solved) return noteNoTiles(s, standing, lattice, result, c, env);
  uint64_t number = 0;
  for (uint32_t z = 0; z < lattice.size[2]; ++z) {
    const Stretch along_z = stretchOf(edges.z, lattice.size[2], z);
    for (uint32_t y = 0; y < lattice.size[1]; ++y) {
      const Stretch along_y = stretchOf(edges.y, lattice.size[1], y);
      for (uint32_t x = 0; x < lattice.size[0]; ++x) {
        if (c.budget.failed()) return;
        const Stretch along_x = stretchOf(edges.x, lattice.size[0], x);
        const StandingTiles::Stand& stand = standing.stands[result.tiles[number]];
        const bool across = stand.quarters % 2 != 0;
        Vec3 scope{along_x.high - along_x.low, along_y.high - along_y.low, along_z.high - along_z.low};
        if (across) std::swap(scope.x, scope.z);
        Placement place = env.place.moved({0.5 * (along_x.low + along_x.high), 0.5 * (along_y.low + along_y.high),
                                           0.5 * (along_z.low + along_z.high)});
        if (stand.quarters != 0) place = place.turned({0, 1, 0}, stand.quarters * (kPi / 2));
        runPart(s, stand.part, number++, place, scope, c, env, out);
      }
    }
  }
}

}  // namespace sgm::interpret
