#include "chunk/thin_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "backend/cpu/instruction_sets.h"
#include "base/vec3.h"
#include "field/evaluate.h"

namespace sgm {
namespace {

constexpr size_t kMostLooks = 32;   ///< examined parts of one statement; its other parts are assumed to be alike
constexpr size_t kTracedCells = 8;  ///< of a layer; later cells are traced if they have thin shapes of a new kind

/// A box around a shape: the shape is as thick as the box's shortest axis.
struct Slab {
  Int3 origin;       ///< of the frame
  Vector3 middle{};  ///< relative to the origin, in world axes
  std::array<Vector3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector3 half{};

  double thickness() const { return 2 * *std::min_element(half.begin(), half.end()); }
};

Vector3 sum(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Int3 placeOf(const Slab& slab, const Vector3& offset) {
  Int3 p;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = slab.middle[static_cast<size_t>(axis)] + offset[static_cast<size_t>(axis)];
    p[axis] = saturate(int64_t{slab.origin[axis]} + static_cast<int64_t>(std::floor(std::clamp(at, -2e9, 2e9) + 0.5)));
  }
  return p;
}

/// Two arbitrary axes perpendicular to the given one.
void axesAlong(Slab& slab, Vector3 along, double length) {
  const size_t least = static_cast<size_t>(
      std::min_element(along.begin(), along.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }) -
      along.begin());
  Vector3 other{};
  other[least] = 1;
  const auto cross = [](const Vector3& a, const Vector3& b) {
    return Vector3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto unit = [](const Vector3& v) {
    const double size = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return size > 0 ? times(v, 1 / size) : Vector3{1, 0, 0};
  };
  slab.axes[1] = length > 0 ? unit(along) : Vector3{0, 1, 0};
  slab.axes[0] = unit(cross(slab.axes[1], other));
  slab.axes[2] = cross(slab.axes[0], slab.axes[1]);
}

/// The slab of a single shape; nullopt for half-spaces, voxels and combiners.
std::optional<Slab> slabOf(const GrammarChunk& chunk, const Shape& s) {
  Slab slab;
  slab.origin = s.frame.origin;
  for (size_t row = 0; row < 3; ++row)
    for (size_t i = 0; i < 3; ++i) slab.axes[row][i] = static_cast<double>(s.frame.rows[3 * row + i]);
  const auto size = [&](size_t i) { return static_cast<double>(s.size[i]); };
  switch (s.kind) {
    case ShapeKind::sphere:
      slab.half = {size(0), size(0), size(0)};
      return slab;
    case ShapeKind::box:
    case ShapeKind::ellipsoid:
    case ShapeKind::superquadric:
      slab.half = {size(0), size(1), size(2)};
      return slab;
    case ShapeKind::cylinder:
      slab.half = {size(0), size(1), size(0)};
      return slab;
    case ShapeKind::truncone: {
      const double widest = std::max(size(0), size(1));
      slab.half = {widest, size(2), widest};
      return slab;
    }
    case ShapeKind::capsule: {
      const Vector3 along{size(1), size(2), size(3)};
      const double length = std::sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
      axesAlong(slab, along, length);
      slab.middle = times(along, 0.5);
      slab.half = {size(0), size(0) + length / 2, size(0)};
      return slab;
    }
    case ShapeKind::torus:
      // A ring is long along its tube.
      slab.middle = times(slab.axes[0], size(0));
      slab.half = {size(1), size(1), std::max(size(0), size(1))};
      return slab;
    case ShapeKind::prism: {
      std::array<double, 2> low{1e30, 1e30}, high{-1e30, -1e30};
      for (uint32_t i = 0; i < s.point_count; ++i) {
        const Int3 corner = chunk.points[s.first_point + i];
        for (size_t k = 0; k < 2; ++k) {
          low[k] = std::min(low[k], static_cast<double>(corner[k == 0 ? 0 : 2]));
          high[k] = std::max(high[k], static_cast<double>(corner[k == 0 ? 0 : 2]));
        }
      }
      if (s.point_count == 0) return std::nullopt;
      slab.middle = sum(times(slab.axes[0], (low[0] + high[0]) / 2), times(slab.axes[2], (low[1] + high[1]) / 2));
      slab.half = {(high[0] - low[0]) / 2, size(0), (high[1] - low[1]) / 2};
      return slab;
    }
    case ShapeKind::morph_power:
      for (size_t i = 0; i < 3; ++i) slab.half[i] = std::max(size(i), size(i + 3));
      return slab;
    default:
      return std::nullopt;
  }
}

/// A thin shape of a cell.
struct Candidate {
  uint32_t shape = 0;
  Slab slab;
  bool cut = false;
};

/// Searches the shapes of a cell that are visible at a level.
class ThinShapes {
 public:
  ThinShapes(const GrammarChunk& chunk, int32_t cell_edge) : chunk_(chunk), cell_edge_(cell_edge) {}

  std::vector<Candidate> find() {
    for (const Group& group : chunk_.groups) visit(group.root, group.cut);
    return std::move(found_);
  }

 private:
  bool shows(const Shape& s) const {
    return (s.detail == 0 || s.detail >= cell_edge_) && (s.coarsest == 0 || s.coarsest <= cell_edge_);
  }
  uint32_t child(const Shape& s, uint32_t i) const { return chunk_.children[s.first_child + i]; }

  /// A sweep's pieces are one shape.
  bool isSweep(const Shape& s) const { return s.kind == ShapeKind::unite && s.point_count > 0; }

  std::optional<Slab> alone(const Shape& s) const {
    if (!isSweep(s)) return slabOf(chunk_, s);
    Slab slab;
    const uint32_t middle = s.first_point + (std::max(s.point_count, 2u) - 2) / 2;
    const Int3 from = chunk_.points[middle],
               to = chunk_.points[std::min(middle + 1, s.first_point + s.point_count - 1)];
    slab.origin = from;
    const Vector3 along{static_cast<double>(int64_t{to.x} - from.x), static_cast<double>(int64_t{to.y} - from.y),
                        static_cast<double>(int64_t{to.z} - from.z)};
    const double length = std::sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
    axesAlong(slab, along, length);
    slab.middle = times(along, 0.5);
    const double r = static_cast<double>(s.size[0]);
    slab.half = {r, std::max(r + length / 2, 0.5 * cell_edge_), r};  // it goes on at both ends
    return slab;
  }

  /// The thickness of the thickest shape in a node: 0 if the node is invisible.
  double thickness(uint32_t index, uint32_t* thickest = nullptr) const {
    const Shape& s = chunk_.shapes[index];
    if (!shows(s)) return 0;
    if (const std::optional<Slab> slab = alone(s)) {
      if (thickest != nullptr) *thickest = index;
      return slab->thickness();
    }
    if (s.child_count == 0) return 1e30;  // a half-space, or voxels
    double most = 0;
    const bool first_alone = s.kind == ShapeKind::subtract || s.kind == ShapeKind::subtract_smooth;
    for (uint32_t i = 0; i < (first_alone ? 1 : s.child_count); ++i) {
      uint32_t of = index;
      const double one = thickness(child(s, i), &of);
      if (one > most && thickest != nullptr) *thickest = of;
      most = std::max(most, one);
    }
    return most;
  }

  void add(uint32_t index, bool cut) {
    const std::optional<Slab> slab = alone(chunk_.shapes[index]);
    if (slab && slab->thickness() < cell_edge_) found_.push_back({index, *slab, cut});
  }

  void visit(uint32_t index, bool cut) {
    const Shape& s = chunk_.shapes[index];
    if (!shows(s)) return;
    if (isSweep(s) || s.child_count == 0) return add(index, cut);
    switch (s.kind) {
      case ShapeKind::subtract:
      case ShapeKind::subtract_smooth:
        for (uint32_t i = 0; i < s.child_count; ++i) visit(child(s, i), cut != (i > 0));
        return;
      case ShapeKind::meet:
      case ShapeKind::meet_smooth: {
        // An intersection is no thicker than either operand.
        double least = 1e30;
        uint32_t thinnest = index;
        for (uint32_t i = 0; i < s.child_count; ++i) {
          uint32_t of = index;
          const double one = thickness(child(s, i), &of);
          if (one < least) least = one, thinnest = of;
        }
        if (least > 0) add(thinnest, cut);
        return;
      }
      case ShapeKind::sum:
      case ShapeKind::morph: {
        uint32_t thickest = index;
        if (thickness(index, &thickest) > 0) add(thickest, cut);
        return;
      }
      default:
        for (uint32_t i = 0; i < s.child_count; ++i) visit(child(s, i), cut);
    }
  }

  const GrammarChunk& chunk_;
  const int32_t cell_edge_;
  std::vector<Candidate> found_;
};

/// Samples the world near a part.
class Surroundings {
 public:
  Surroundings(const WorldField& world, int level) : world_(world), level_(level), cell_(world.cellAt(level)) {}

  /// Whether the part stands free: along more than half of it, nothing thicker lies beside it.
  Result<bool> standsAlone(const Slab& slab, bool cut) {
    // Sample places from end to end along the axes that are not thin.
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
          more.push_back(sum(place, times(slab.axes[axis], share * slab.half[axis])));
      places = std::move(more);
    }
    double far = 0;
    for (const double half : slab.half) far += half;
    const auto reach = static_cast<int32_t>(std::min(far + 3.0 * cell_, 1e8));
    const Int3 middle = placeOf(slab, {});
    const Result<std::shared_ptr<const FieldProgram>> program =
        world_.compile(IntBox{middle, middle}.grown(reach), level_);
    if (!program) return program.error();
    // Sample each place, and two distances beside it along each thin axis on both sides.
    std::vector<Int3> points;
    for (const Vector3& place : places) {
      points.push_back(placeOf(slab, place));
      for (const size_t axis : thin)
        for (const double way : {1.0, -1.0})
          for (const double cells : {0.4, 0.9})
            points.push_back(
                placeOf(slab, sum(place, times(slab.axes[axis], way * (slab.half[axis] + cells * cell_)))));
    }
    const std::vector<bool> there = solidAt(**program, points, cut);
    size_t present = 0, carried = 0;
    for (size_t first = 0; first < points.size(); first += 1 + 4 * thin.size()) {
      if (!there[first]) continue;  // cut away, or filled again
      const auto beside = [&](size_t k, size_t way) {
        const size_t close = first + 1 + 4 * k + 2 * way;
        return there[close] && there[close + 1];
      };
      bool all_both = true, any = false;
      for (size_t k = 0; k < thin.size(); ++k) {
        all_both = all_both && beside(k, 0) && beside(k, 1);
        any = any || beside(k, 0) || beside(k, 1);
      }
      if (cut && all_both) continue;  // outside of the solid that it is cut from
      ++present;
      carried += any;
    }
    return present > 0 && 2 * carried < present;
  }

 private:
  /// Whether each point is solid, or void where `cut`.
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

/// "net(0, 0, -1)/Node/cave.Column[3]" as "cave.Column".
std::string ruleOf(const std::string& path) {
  std::string last = path.substr(path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1);
  if (last == "override") return "an override";
  return last.substr(0, last.find('['));
}

/// Recognises the statement of a thin shape, without deriving its cell anew.
using ThinKind = std::tuple<ShapeKind, double, bool, uint16_t, uint16_t, int32_t, int32_t>;
ThinKind lookOf(const GrammarChunk& chunk, const Candidate& thin) {
  const Shape& s = chunk.shapes[thin.shape];
  return {s.kind, thin.slab.thickness(), thin.cut, s.material, s.tag, s.detail, s.coarsest};
}

/// Counts the thin parts of a world separately for each statement, so that a slab on the ground hides no pole beside
/// it.
class PartCounter {
 public:
  PartCounter(const WorldField& world, const IntBox& box, int level)
      : world_(world), box_(box), cell_edge_(world.cellAt(level)), surroundings_(world, level) {
    // The command warns of treemap walls itself, whatever is derived.
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
  using Place = std::tuple<std::string, bool, uint32_t, uint32_t>;  ///< rule, cut, file and place of the statement
  using Use = std::tuple<uint32_t, Int3, uint32_t>;                 ///< layer, cell, use
  struct Found {
    int32_t thickness = INT32_MAX;
    std::set<Use> uses;   ///< of the rule, in traced cells
    size_t untraced = 0;  ///< in other cells
    size_t looked = 0, alone = 0;
    std::set<Use> seen;          ///< uses with a thin shape of this statement
    bool one_shape_each = true;  ///< as far as seen
  };

  Result<void> countCell(uint32_t layer, Int3 at) {
    const auto cell = world_.cellFor(layer, at, cell_edge_);
    if (!cell) return cell.error();
    const GrammarChunk& chunk = (*cell)->chunk;
    const std::vector<Candidate> thin = ThinShapes(chunk, cell_edge_).find();
    if (thin.empty()) return {};
    if (traced_ >= kTracedCells && std::ranges::all_of(thin, [&](const Candidate& c) { return isKnown(chunk, c); })) {
      for (const Candidate& c : thin) {
        const std::optional<Place>& place = known_.at(lookOf(chunk, c));
        if (!place || !box_.contains(placeOf(c.slab, {}))) continue;
        Found& found = found_[*place];
        const Result<bool> counts = countsAs(found, c);
        if (!counts) return counts.error();
        if (*counts) ++found.untraced;
      }
      return {};
    }
    return countTraced(layer, at);
  }

  bool isKnown(const GrammarChunk& chunk, const Candidate& thin) const {
    const auto known = known_.find(lookOf(chunk, thin));
    if (known == known_.end() || several_.contains(known->first)) return false;
    return !known->second || found_.at(*known->second).one_shape_each;
  }

  Result<void> countTraced(uint32_t layer, Int3 at) {
    ++traced_;
    const Result<TracedCell> traced = world_.trace(layer, at);
    if (!traced) return traced.error();
    for (const Candidate& thin : ThinShapes(traced->chunk, cell_edge_).find()) {
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
      if (!box_.contains(placeOf(thin.slab, {}))) continue;
      const Result<bool> counts = countsAs(found, thin);
      if (!counts) return counts.error();
      if (*counts) found.uses.insert(use);
    }
    return {};
  }

  /// Whether a part counts: it stands free, or is assumed to, as other parts of its statement do.
  Result<bool> countsAs(Found& found, const Candidate& thin) {
    if (found.looked < kMostLooks) {
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
  std::map<ThinKind, std::optional<Place>> known_;  ///< of the layer's traced cells; nullopt for walls
  std::set<ThinKind> several_;                      ///< shared by shapes of several statements
  size_t traced_ = 0;                               ///< traced cells of the layer
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
