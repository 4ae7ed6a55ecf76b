#include "chunk/thin_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "backend/cpu/instruction_sets.h"
#include "base/vec3.h"
#include "chunk/thin_shapes.h"
#include "field/evaluate.h"

namespace sgm {
namespace {

/// maximum number of parts of one statement whose surroundings are sampled; if one of these parts stands free, all
/// further parts count as thin
constexpr size_t kMaxLooks = 32;
/// number of cells of a layer that are always traced; later cells are traced only if they have thin shapes of a new
/// kind
constexpr size_t kTracedCells = 8;

/// Samples the world near a thin part.
class Surroundings {
 public:
  Surroundings(const WorldField& world, int level) : world_(world), level_(level), cell_(world.cellAt(level)) {}

  /// Whether the part stands free: along more than half of its extent, there is no thicker solid (for a part that is
  /// cut away: no thicker void) directly beside it.
  Result<bool> standsAlone(const Slab& slab, bool cut) {
    // Choose sample places from end to end along the axes that are not thin.
    std::vector<Vector3> places{{}};
    std::vector<size_t> thin;
    for (size_t axis = 0; axis < 3; ++axis) {
      if (2 * slab.half[axis] < cell_) {
        thin.push_back(axis);
        continue;
      }
      std::vector<Vector3> more;
      for (const Vector3& place : places)
        for (const double share : {-0.7, 0.0, 0.7})
          more.push_back(plus(place, times(slab.axes[axis], share * slab.half[axis])));
      places = std::move(more);
    }
    double far = 0;
    for (const double half : slab.half) far += half;
    const auto reach = static_cast<int32_t>(std::min(far + 3.0 * cell_, 1e8));
    const Int3 middle = placeIn(slab);
    const Result<std::shared_ptr<const FieldProgram>> program =
        world_.compile(IntBox{middle, middle}.grown(reach), level_);
    if (!program) return program.error();
    // At each place, sample the place itself and, on both sides of each thin axis, two points at different distances.
    std::vector<Int3> points;
    for (const Vector3& place : places) {
      points.push_back(placeIn(slab, place));
      for (const size_t axis : thin)
        for (const double way : {1.0, -1.0})
          for (const double cells : {0.4, 0.9})
            points.push_back(
                placeIn(slab, plus(place, times(slab.axes[axis], way * (slab.half[axis] + cells * cell_)))));
    }
    const std::vector<bool> there = solidAt(**program, points, cut);
    size_t present = 0, carried = 0;
    for (size_t first = 0; first < points.size(); first += 1 + 4 * thin.size()) {
      // Skip the place if another statement has cut away the added part here, or has filled the cut part again.
      if (!there[first]) continue;
      const auto beside = [&](size_t k, size_t way) {
        const size_t close = first + 1 + 4 * k + 2 * way;
        return there[close] && there[close + 1];
      };
      bool all_both = true, any = false;
      for (size_t k = 0; k < thin.size(); ++k) {
        all_both = all_both && beside(k, 0) && beside(k, 1);
        any = any || beside(k, 0) || beside(k, 1);
      }
      // Skip the place if a cut part has void on all sides: it lies outside of the solid here, and cuts nothing.
      if (cut && all_both) continue;
      ++present;
      carried += any;
    }
    return present > 0 && 2 * carried < present;
  }

 private:
  /// Returns for each point whether it is solid; with `cut`, whether it is void.
  std::vector<bool> solidAt(const FieldProgram& program, const std::vector<Int3>& points, bool cut) {
    std::vector<int32_t> x, y, z;
    for (const Int3& p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
    std::vector<float> values(points.size());
    Attributes wanted;
    wanted.value = values.data();
    bestKernels().attributes(program.view(), {x.data(), y.data(), z.data(), points.size()}, scratch_, wanted);
    std::vector<bool> solid;
    for (const float value : values) solid.push_back((value < 0) != cut);
    return solid;
  }

  const WorldField& world_;
  const int level_;
  const double cell_;
  EvalScratch scratch_;
};

/// Returns the rule at the end of a path: "cave.Column" for "net(0, 0, -1)/Node/cave.Column[3]".
std::string ruleOf(const std::string& path) {
  std::string last = path.substr(path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1);
  if (last == "override") return "an override";
  return last.substr(0, last.find('['));
}

/// Properties of a thin shape by which its statement is recognised without tracing the cell again.
using ThinKind = std::tuple<ShapeKind, double, bool, uint16_t, uint16_t, int32_t, int32_t>;
ThinKind lookOf(const GrammarChunk& chunk, const ThinShape& thin) {
  const Shape& s = chunk.shapes[thin.shape];
  return {s.kind, thin.slab.thickness(), thin.cut, s.material, s.tag, s.detail, s.coarsest};
}

/// Counts the thin parts of each statement separately. So parts of one statement that do not stand free (a slab on the
/// ground) do not hide the parts of another statement (a pole beside it).
class PartCounter {
 public:
  PartCounter(const WorldField& world, const IntBox& box, int level)
      : world_(world), box_(box), cell_edge_(world.cellAt(level)), surroundings_(world, level) {
    // Treemap walls are not counted, since the command line tool reports them separately, independently of the meshed
    // region.
    for (const StmtNode& s : world.settings().program->ast.stmts)
      if (s.kind == StmtKind::treemap) walls_.emplace(s.span.file, s.span.begin);
  }

  Result<void> count(uint32_t layer) {
    known_.clear();
    traced_ = 0;
    return world_.cellsAround(layer, box_, [&](Int3 at) { return countCell(layer, at); });
  }

  std::vector<ThinPart> parts() const {
    std::map<std::pair<std::string, bool>, ThinPart> by_rule;
    std::map<std::pair<std::string, bool>, std::set<Use>> uses;
    for (const auto& [place, found] : found_) {
      if (found.uses.empty() && found.untraced == 0) continue;
      const std::pair<std::string, bool> name{std::get<0>(place), std::get<1>(place)};
      const auto [part, is_new] =
          by_rule.try_emplace(name, ThinPart{name.first, name.second, found.thickness, 0, false});
      part->second.thickness = std::min(part->second.thickness, found.thickness);
      part->second.uses += found.untraced;
      part->second.is_about = part->second.is_about || found.untraced > 0;
      uses[name].insert(found.uses.begin(), found.uses.end());
    }
    std::vector<ThinPart> parts;
    for (auto& [name, part] : by_rule) {
      part.uses += uses[name].size();
      parts.push_back(part);
    }
    return parts;
  }

 private:
  /// identifies a statement: its rule, whether it cuts, its file, and its position in the file
  using Place = std::tuple<std::string, bool, uint32_t, uint32_t>;
  /// identifies a use of a rule: layer, cell, index of the activation
  using Use = std::tuple<uint32_t, Int3, uint32_t>;
  struct Found {
    int32_t thickness = INT32_MAX;
    std::set<Use> uses;   ///< uses of the rule that have a thin part of this statement, in traced cells
    size_t untraced = 0;  ///< number of thin shapes in cells that were not traced
    size_t looked = 0, alone = 0;
    std::set<Use> seen;          ///< all uses with a thin shape of this statement, in traced cells
    bool one_shape_each = true;  ///< true as long as every use in `seen` has exactly one thin shape of this statement
  };

  Result<void> countCell(uint32_t layer, Int3 at) {
    const auto cell = world_.cellFor(layer, at, cell_edge_);
    if (!cell) return cell.error();
    const GrammarChunk& chunk = (*cell)->chunk;
    const std::vector<ThinShape> thin = findThinShapes(chunk, cell_edge_);
    if (thin.empty()) return {};
    if (traced_ >= kTracedCells && std::ranges::all_of(thin, [&](const ThinShape& c) { return isKnown(chunk, c); })) {
      for (const ThinShape& c : thin) {
        const std::optional<Place>& place = known_.at(lookOf(chunk, c));
        if (!place || !box_.contains(placeIn(c.slab))) continue;
        Found& found = found_[*place];
        const Result<bool> counts = countsAs(found, c);
        if (!counts) return counts.error();
        if (*counts) ++found.untraced;
      }
      return {};
    }
    return countTraced(layer, at);
  }

  bool isKnown(const GrammarChunk& chunk, const ThinShape& thin) const {
    const auto known = known_.find(lookOf(chunk, thin));
    if (known == known_.end() || several_.contains(known->first)) return false;
    return !known->second || found_.at(*known->second).one_shape_each;
  }

  Result<void> countTraced(uint32_t layer, Int3 at) {
    ++traced_;
    const Result<TracedCell> traced = world_.trace(layer, at);
    if (!traced) return traced.error();
    for (const ThinShape& thin : findThinShapes(traced->chunk, cell_edge_)) {
      const ShapeOrigin& origin = traced->origins[thin.shape];
      std::optional<Place> place;
      if (!walls_.contains({origin.span.file, origin.span.begin}))
        place = Place{ruleOf(traced->uses[origin.use]), thin.cut, origin.span.file, origin.span.begin};
      const auto [known, is_new] = known_.try_emplace(lookOf(traced->chunk, thin), place);
      if (!is_new && known->second != place) several_.insert(known->first);
      if (!place) continue;
      Found& found = found_[*place];
      const Use use{layer, at, origin.use};
      if (!found.seen.insert(use).second) found.one_shape_each = false;
      if (!box_.contains(placeIn(thin.slab))) continue;
      const Result<bool> counts = countsAs(found, thin);
      if (!counts) return counts.error();
      if (*counts) found.uses.insert(use);
    }
    return {};
  }

  /// Whether a part counts as thin. Samples the surroundings of the first kMaxLooks parts of a statement: such a part
  /// counts if it stands free. Further parts count, without sampling, if any of the first parts stood free.
  Result<bool> countsAs(Found& found, const ThinShape& thin) {
    if (found.looked < kMaxLooks) {
      const Result<bool> alone = surroundings_.standsAlone(thin.slab, thin.cut);
      if (!alone) return alone.error();
      ++found.looked;
      if (!*alone) return false;
      ++found.alone;
    } else if (found.alone == 0) {
      return false;
    }
    found.thickness = std::min(found.thickness, static_cast<int32_t>(std::ceil(thin.slab.thickness() - 1e-3)));
    return true;
  }

  const WorldField& world_;
  const IntBox box_;
  const int32_t cell_edge_;
  Surroundings surroundings_;
  std::set<std::pair<uint32_t, uint32_t>> walls_;
  std::map<Place, Found> found_;
  /// for each kind of thin shape in the layer's traced cells: the statement that makes this kind; nullopt for treemap
  /// walls
  std::map<ThinKind, std::optional<Place>> known_;
  std::set<ThinKind> several_;  ///< kinds of thin shapes that are made by several statements
  size_t traced_ = 0;           ///< number of traced cells of the layer
};

}  // namespace

Result<std::vector<ThinPart>> thinParts(const WorldField& world, const IntBox& box, int level) {
  const Program& program = *world.settings().program;
  PartCounter counter(world, box, level);
  for (uint32_t layer = 0; layer < program.layers.size(); ++layer) {
    if (!program.layers[layer].shows(world.cellAt(level))) continue;
    if (const Result<void> counted = counter.count(layer); !counted) return counted.error();
  }
  return counter.parts();
}

}  // namespace sgm
