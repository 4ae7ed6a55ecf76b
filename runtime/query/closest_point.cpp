#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

#include "query/query_sampler.h"

namespace sgm {

namespace {

constexpr int kNearBrick = 4;  // edge of a brick in cells; the samples of a brick are evaluated together
// distance in cells within which the search starts, so that a near surface is found without compiling distant parts
constexpr int64_t kFirstSearch = 16;
constexpr int64_t kSearchGrowth = 4;
constexpr double kNoDistance = std::numeric_limits<double>::infinity();
// the search along the surface ends when no step brings it nearer to the queried place by at least this many units
constexpr double kNearest = 0.25;

/// A range of bricks (cubes of kNearBrick^3 cells), or a box, that may contain the surface; and a lower bound of its
/// distance from the queried place.
struct Candidate {
  double lower = 0;
  int rank = 0;  ///< 0: several bricks; 1: one brick; 2: a box
  IntBox box;    ///< for bricks, the range of their coordinates; for a box, its corners in units
  std::shared_ptr<const PrunedProgram> program;

  /// Orders a priority queue: the nearest candidate comes first. Among equally near candidates, bricks come before
  /// boxes, and lower coordinates before higher ones. So boxes are found in the same order, whichever bounds were
  /// proven for the bricks around them.
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return std::tie(b.lower, b.rank, b.box.lo, b.box.hi) < std::tie(a.lower, a.rank, a.box.lo, a.box.hi);
  }
};

/// Finds the surface point nearest to a place: first the nearest sample on the other side of the surface, by best-first
/// search over an octree, and then the surface between the place and that sample.
class SurfaceSearch {
 public:
  SurfaceSearch(const QueryField& field, const SplitPosition& place, double radius)
      : field_(field),
        cell_(field.finest_cell),
        place_(place),
        radius_(radius),
        sampler_(field.memory),
        open_(std::less<Candidate>{}, std::pmr::vector<Candidate>(field.memory)) {}

  Result<std::optional<SurfacePoint>> run() {
    // All corners of the cells from world_first to world_last lie in the world.
    const int64_t world_first = -(INT64_C(2147483648) / cell_), world_last = INT64_C(2147483647) / cell_ - 1;
    IntBox bricks;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = place_.base[axis];
      const auto cellAt = [&](double units) {
        return std::clamp(static_cast<int64_t>(std::floor(units / cell_)), world_first, world_last);
      };
      first_cell_[axis] = static_cast<int32_t>(cellAt(at - radius_ - 1));
      last_cell_[axis] = static_cast<int32_t>(cellAt(at + radius_ + 1));
      bricks.lo[axis] = static_cast<int32_t>(floorDiv(first_cell_[axis], kNearBrick));
      bricks.hi[axis] = static_cast<int32_t>(floorDiv(last_cell_[axis], kNearBrick));
    }
    const Int3 home = place_.at({});
    Result<std::shared_ptr<const FieldProgram>> program = field_.at(unitBox(bricks).joined({home, home}));
    if (!program) return program.error();
    inside_ = sampler_.solid((*program)->view(), home);
    auto whole = std::make_shared<PrunedProgram>(field_.memory);
    prune((*program)->view(), unitBox(bricks), sampler_.pruning, *whole);
    if (whole->solid() || whole->empty()) return std::optional<SurfacePoint>{};
    push({0, 0, bricks, std::move(whole)});
    while (!open_.empty() && worthALook(open_.top())) {
      const Candidate next = open_.top();
      open_.pop();
      if (next.rank == 2) {
        halve(next);
      } else {
        look(next);
      }
    }
    if (nearest_ == kNoDistance) return std::optional<SurfacePoint>{};
    return std::optional<SurfacePoint>(foot((*program)->view()));
  }

 private:
  bool worthALook(const Candidate& candidate) const {
    return nearest_ == kNoDistance || candidate.lower < nearest_ - (cell_ / 4.0 + nearest_ / 64);
  }

  IntBox unitBox(const IntBox& bricks) const {
    IntBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = cell_ * std::max(bricks.lo[axis] * kNearBrick, first_cell_[axis]);
      box.hi[axis] = cell_ * (std::min(bricks.hi[axis] * kNearBrick + kNearBrick - 1, last_cell_[axis]) + 1);
    }
    return box;
  }

  double distanceTo(const IntBox& box) const {
    const Vector3 lo = place_.to(box.lo), hi = place_.to(box.hi);
    double squares = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double away = std::max({lo[axis], -hi[axis], 0.0});
      squares += away * away;
    }
    return std::sqrt(squares);
  }

  void push(Candidate candidate) {
    candidate.lower = distanceTo(candidate.rank == 2 ? candidate.box : unitBox(candidate.box));
    if (candidate.rank == 0 && candidate.box.lo == candidate.box.hi) candidate.rank = 1;
    if (candidate.lower <= radius_ && candidate.lower < nearest_) open_.push(std::move(candidate));
  }

  void look(const Candidate& bricks) {
    auto program = std::make_shared<PrunedProgram>(field_.memory);
    const IntBox box = unitBox(bricks.box);
    prune(bricks.program->view(), box, sampler_.pruning, *program);
    if (program->solid() || program->empty()) return;
    if (bricks.rank == 1) return sampleLattice(box, cell_, std::move(program));
    int longest = 0;
    const auto edge = [&](int axis) { return bricks.box.hi[axis] - bricks.box.lo[axis]; };
    for (int axis = 1; axis < 3; ++axis) longest = edge(axis) > edge(longest) ? axis : longest;
    IntBox low = bricks.box, high = bricks.box;
    low.hi[longest] = bricks.box.lo[longest] + edge(longest) / 2;
    high.lo[longest] = low.hi[longest] + 1;
    push({0, 0, low, program});
    push({0, 0, high, program});
  }

  void halve(const Candidate& box) {
    int32_t longest = 0;
    for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, box.box.hi[axis] - box.box.lo[axis]);
    if (longest > 1) sampleLattice(box.box, (longest + 1) / 2, box.program);
  }

  /// Samples a box at this spacing, including its high faces. Queues each small box between adjacent samples whose
  /// eight corners differ in sign.
  void sampleLattice(const IntBox& box, int32_t spacing, std::shared_ptr<const PrunedProgram> program) {
    std::array<std::vector<int32_t>, 3> at;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<int32_t>& line = at[static_cast<size_t>(axis)];
      for (int64_t p = box.lo[axis]; p < box.hi[axis]; p += spacing) line.push_back(static_cast<int32_t>(p));
      line.push_back(box.hi[axis]);
    }
    sampler_.clear();
    for (int32_t z : at[2]) {
      for (int32_t y : at[1]) {
        for (int32_t x : at[0]) sampler_.add({x, y, z});
      }
    }
    const std::pmr::vector<int32_t>& q = sampler_.samples(program->view());
    const size_t row = at[0].size(), plane = row * at[1].size();
    for (size_t z = 0; z + 1 < at[2].size(); ++z) {
      for (size_t y = 0; y + 1 < at[1].size(); ++y) {
        for (size_t x = 0; x + 1 < row; ++x) {
          unsigned solid = 0;
          for (size_t c = 0; c < 8; ++c) {
            const size_t i = x + (c & 1) + row * (y + (c >> 1 & 1)) + plane * (z + (c >> 2));
            solid |= static_cast<unsigned>(q[i] < 0) << c;
          }
          if (solid == 0 || solid == 255) continue;
          for (size_t c = 0; c < 8; ++c) {
            if ((solid >> c & 1) == (inside_ ? 1u : 0u)) continue;
            meet({at[0][x + (c & 1)], at[1][y + (c >> 1 & 1)], at[2][z + (c >> 2)]});
          }
          push({0, 2, {{at[0][x], at[1][y], at[2][z]}, {at[0][x + 1], at[1][y + 1], at[2][z + 1]}}, program});
        }
      }
    }
  }

  /// Records a sample that lies on the other side of the surface than the queried place, if it is the nearest one so
  /// far.
  void meet(const Int3& sample) {
    const Vector3 to = place_.to(sample);
    const double distance = std::sqrt(dot(to, to));
    if (distance > nearest_ || (distance == nearest_ && sample >= beyond_)) return;
    nearest_ = distance;
    beyond_ = sample;
  }

  /// Moves from the nearest sample to the surface, and then along the surface as long as the distance decreases.
  SurfacePoint foot(const ProgramView& whole) {
    IntBox near = IntBox{place_.base, place_.base}.grown(static_cast<int32_t>(nearest_) + 2);
    PrunedProgram pruned(field_.memory);
    prune(whole, near, sampler_.pruning, pruned);
    const bool proven = pruned.solid() || pruned.empty();
    const ProgramView view = proven ? whole : pruned.view();
    Vector3 direction = times(place_.to(beyond_), nearest_ > 0 ? 1 / nearest_ : 0);
    double open = 0, closed = nearest_;
    cut(view, direction, open, closed);
    SurfacePoint found = surface(view, direction, open, closed);
    for (double share = 1; share > 0.01;) {
      Vector3 turned;
      for (size_t axis = 0; axis < 3; ++axis) {
        turned[axis] = (1 - share) * direction[axis] + share * found.normal[axis] * (inside_ ? 1 : -1);
      }
      const double size = std::sqrt(dot(turned, turned));
      double nearer_open = 0, nearer = open - kNearest;
      if (size > 0.01) turned = times(turned, 1 / size);
      if (size <= 0.01 || nearer <= 0 || sampler_.solid(view, place_.at(times(turned, nearer))) == inside_) {
        share /= 2;
        continue;
      }
      cut(view, turned, nearer_open, nearer);
      direction = turned;
      open = nearer_open;
      found = surface(view, direction, open, nearer);
    }
    return found;
  }

  /// Bisects the interval of distances `open` to `closed` along `direction`, whose ends lie on different sides of the
  /// surface, down to a quarter of a unit. Updates both ends.
  void cut(const ProgramView& view, const Vector3& direction, double& open, double& closed) {
    while (closed - open > kNearest) {
      const double middle = open + (closed - open) / 2;
      (sampler_.solid(view, place_.at(times(direction, middle))) == inside_ ? open : closed) = middle;
    }
  }

  SurfacePoint surface(const ProgramView& view, const Vector3& direction, double open, double closed) {
    SurfacePoint point = sampler_.surface(view, place_.at(times(direction, inside_ ? open : closed)));
    point.position = place_.position(times(direction, open));
    point.distance = open;
    point.inside = inside_;
    return point;
  }

  const QueryField& field_;
  const int32_t cell_;
  const SplitPosition place_;
  const double radius_;
  QuerySampler sampler_;
  Int3 first_cell_, last_cell_;
  bool inside_ = false;
  std::priority_queue<Candidate, std::pmr::vector<Candidate>> open_;
  double nearest_ = kNoDistance;
  Int3 beyond_;  ///< nearest known sample on the other side of the surface
};

}  // namespace

int64_t farthestSurface(int32_t finest_cell) {
  return std::max(int64_t{64} * kUnitsPerMetre, int64_t{256} * finest_cell);
}

Result<std::optional<SurfacePoint>> closestPoint(const QueryField& field, const Vector3& place, double max_distance) {
  const Result<SplitPosition> at = splitPosition(place);
  if (!at) return at.error();
  if (const Result<void> ok = checkLength(max_distance, farthestSurface(field.finest_cell), "the distance"); !ok)
    return ok.error();
  double radius = std::min(max_distance, static_cast<double>(kFirstSearch * field.finest_cell));
  while (true) {
    Result<std::optional<SurfacePoint>> found = SurfaceSearch(field, *at, radius).run();
    if (!found || (*found && (*found)->distance <= radius)) return found;
    if (radius == max_distance) return std::optional<SurfacePoint>{};
    radius = std::min(max_distance, radius * kSearchGrowth);
  }
}

}  // namespace sgm
