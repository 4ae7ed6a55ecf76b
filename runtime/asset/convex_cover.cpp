// How the cover is found. A BSP tree of the faces' planes divides the polyhedron's inside into convex cells. Consider a
// point where several cells meet, all of them solid. Take the half-spaces that bound those cells, except the
// half-spaces whose planes pass through the point. Their intersection is convex, contains the point strictly, and is
// solid. (Proof: take the segment from the point to any other point of the intersection. Near the first point, the
// segment lies in one of the cells. It cannot leave that cell through a plane of the first point, because it began
// there; nor through another plane, because both ends lie on the inner side of it.)
//
// All points within a cell, within a face that two cells share, and within an edge between corners of such faces meet
// the same cells; so covering one point of each of these features covers the whole inside. Each piece is then enlarged:
// it loses every half-space that is not needed to exclude a void cell. A large piece covers many features: a wall with
// m by n windows takes m + n + 2 pieces.

#include "asset/convex_cover.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace sgm::asset {

namespace {

/// A cell, a face that two cells share, or a part of such a face's border: all its inner points touch the same cells.
struct Feature {
  Loop corners;
  Point middle;
};

struct GrownPiece {
  std::vector<Side> sides;
  std::vector<uint32_t> covers;  ///< indices of the features that the piece covers
};

class CoverFinder {
 public:
  CoverFinder(const Polyhedron& solid, const BspCells& cells, const CoverLimits& limits)
      : solid_(solid), cells_(cells), limits_(limits) {}

  Result<std::vector<ConvexPiece>> run() {
    for (const BspCell& cell : cells_.cells)
      if (cell.winding < 0) return Error{Code::bad_input, "it intersects itself", 0, 0};
    relateCells();
    coverCells();
    findPortals();
    findEdges();
    if (features_.size() > limits_.features || pieces_.size() > limits_.pieces)
      return Error{Code::limit, "it falls into more than " + std::to_string(limits_.pieces) + " convex pieces", 0, 0};
    dropSuperfluous();
    triangles_.resize(2 * planeCount());
    for (uint32_t t = 0; t < solid_.triangles.size(); ++t) {
      const uint32_t face = solid_.face_of[t];
      triangles_[2 * cells_.plane_of[face] + (cells_.turned[face] ? 1 : 0)].push_back(t);
    }
    std::vector<ConvexPiece> out;
    for (const GrownPiece& piece : pieces_) out.push_back(finished(piece.sides));
    return out;
  }

 private:
  double tolerance() const { return cells_.tolerance; }
  size_t planeCount() const { return cells_.planes.size(); }

  /// Finds, for each half-space of each plane, the void cells that lie entirely in it; also the bounding box of each
  /// cell.
  void relateCells() {
    for (uint32_t c = 0; c < cells_.cells.size(); ++c) {
      const BspCell& cell = cells_.cells[c];
      Point low = cell.middle, high = cell.middle;
      for (const ConvexCell::Facet& facet : cell.body.facets)
        for (const Point& p : facet.loop)
          for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], p[axis]);
            high[axis] = std::max(high[axis], p[axis]);
          }
      boxes_.emplace_back(low, high);
      if (!cell.solid) void_.push_back(c);
    }
    outside_.assign(2 * planeCount(), {});
    for (size_t plane = 0; plane < planeCount(); ++plane)
      for (uint32_t v = 0; v < void_.size(); ++v) {
        const auto [least, most] = cells_.cells[void_[v]].body.range(cells_.planes[plane]);
        if (least >= -tolerance()) outside_[2 * plane].push_back(v);
        if (most <= tolerance()) outside_[2 * plane + 1].push_back(v);
      }
  }

  /// Returns the void cells that a piece excludes if it is bounded by this side.
  const std::vector<uint32_t>& leftOut(Side side) const { return outside_[2 * side.plane + (side.before ? 1 : 0)]; }

  /// Enlarges a piece: removes the sides that are not needed to exclude a void cell.
  std::vector<Side> grown(std::vector<Side> sides) const {
    std::vector<uint32_t> count(void_.size(), 0);
    for (const Side side : sides)
      for (const uint32_t v : leftOut(side)) ++count[v];
    // A void cell may be excluded by no single side, but only by several sides together. This is rare; all sides are
    // then kept, since a smaller piece is also correct.
    if (std::find(count.begin(), count.end(), 0u) != count.end()) return sides;
    // First tries to remove the sides that exclude the most void cells; among equals, the sides that were cut last.
    // These sides lie farthest inside: once they are removed, sides farther outside may suffice.
    std::reverse(sides.begin(), sides.end());
    std::stable_sort(sides.begin(), sides.end(), [&](Side a, Side b) { return leftOut(a).size() > leftOut(b).size(); });
    std::vector<Side> kept;
    for (const Side side : sides) {
      const auto& out = leftOut(side);
      if (std::all_of(out.begin(), out.end(), [&](uint32_t v) { return count[v] > 1; }))
        for (const uint32_t v : out) --count[v];
      else
        kept.push_back(side);
    }
    return kept;
  }

  bool covers(const std::vector<Side>& sides, const Feature& feature) const {
    for (const Side side : sides) {
      const Plane plane = cells_.sidePlane(side);
      if (plane.distance(feature.middle) > -0.5 * tolerance()) return false;
      for (const Point& p : feature.corners)
        if (plane.distance(p) > 2 * tolerance()) return false;
    }
    return true;
  }

  /// Adds a feature to the list, and a new piece if no piece covers the feature. sides: the sides of the new piece
  /// before it is enlarged.
  void addFeature(Feature feature, std::vector<Side> sides) {
    features_.push_back(std::move(feature));
    for (const GrownPiece& piece : pieces_)
      if (covers(piece.sides, features_.back())) return;
    pieces_.push_back({grown(std::move(sides)), {}});
  }

  void coverCells() {
    std::vector<std::pair<double, uint32_t>> order;
    for (uint32_t c = 0; c < cells_.cells.size(); ++c)
      if (cells_.cells[c].solid) order.emplace_back(-cells_.cells[c].body.volume(), c);
    std::sort(order.begin(), order.end());
    for (const auto& [volume, c] : order) {
      Feature feature{{}, cells_.cells[c].middle};
      for (const ConvexCell::Facet& facet : cells_.cells[c].body.facets)
        feature.corners.insert(feature.corners.end(), facet.loop.begin(), facet.loop.end());
      addFeature(std::move(feature), cells_.cells[c].sides);
    }
  }

  /// Returns the half-spaces that bound the cells `meeting`, except those whose planes pass through the point `at`.
  std::vector<Side> sidesAt(const std::vector<uint32_t>& meeting, Point at) const {
    std::vector<Side> sides;
    for (const uint32_t c : meeting)
      for (const Side side : cells_.cells[c].sides)
        if (std::fabs(cells_.planes[side.plane].distance(at)) > tolerance() &&
            std::find(sides.begin(), sides.end(), side) == sides.end())
          sides.push_back(side);
    return sides;
  }

  static bool boxesMeet(const std::pair<Point, Point>& a, const std::pair<Point, Point>& b, double tolerance) {
    for (int axis = 0; axis < 3; ++axis)
      if (a.first[axis] > b.second[axis] + tolerance || b.first[axis] > a.second[axis] + tolerance) return false;
    return true;
  }

  /// Finds the portals: the faces that two solid cells share.
  void findPortals() {
    struct FacetOf {
      uint32_t cell;
      const ConvexCell::Facet* facet;
    };
    std::vector<std::vector<FacetOf>> behind(planeCount()), before(planeCount());
    for (uint32_t c = 0; c < cells_.cells.size(); ++c) {
      if (!cells_.cells[c].solid) continue;
      for (const ConvexCell::Facet& facet : cells_.cells[c].body.facets)
        for (const Side side : cells_.cells[c].sides)
          if (cells_.sidePlane(side).normal == facet.plane.normal &&
              cells_.sidePlane(side).offset == facet.plane.offset) {
            (side.before ? before : behind)[side.plane].push_back({c, &facet});
            break;
          }
    }
    for (uint32_t plane = 0; plane < planeCount(); ++plane)
      for (const FacetOf& a : behind[plane])
        for (const FacetOf& b : before[plane]) {
          if (!boxesMeet(boxes_[a.cell], boxes_[b.cell], tolerance())) continue;
          Loop shared = a.facet->loop;
          for (const ConvexCell::Facet& facet : cells_.cells[b.cell].body.facets)
            if (&facet != b.facet) shared = clippedLoop(shared, facet.plane, tolerance());
          if (shared.size() < 3 || areaOf(shared) <= tolerance() * solid_.longestEdge()) continue;
          portals_.push_back(shared);
          const Point middle = middleOf(shared);
          addFeature({std::move(shared), middle}, sidesAt({a.cell, b.cell}, middle));
          if (features_.size() > limits_.features) return;
        }
  }

  /// Adds features for the corners and edges of the portals (faces that two solid cells share); an edge is split where
  /// corners of other portals lie on it.
  void findEdges() {
    std::vector<Point> corners;
    for (const Loop& loop : portals_) corners.insert(corners.end(), loop.begin(), loop.end());
    const auto less = [](Point a, Point b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
    std::sort(corners.begin(), corners.end(), less);
    std::vector<Point> apart;
    for (const Point& p : corners) {
      bool known = false;
      for (size_t i = apart.size(); i-- > 0 && p.x - apart[i].x <= tolerance() && !known;)
        known = length(p - apart[i]) <= tolerance();
      if (!known) apart.push_back(p);
    }
    for (const Point& p : apart) meetingPoint({{}, p});
    for (const Loop& loop : portals_)
      for (size_t i = 0; i < loop.size() && features_.size() <= limits_.features; ++i)
        edge(loop[i], loop[(i + 1) % loop.size()], apart);
  }

  void edge(Point a, Point b, const std::vector<Point>& corners) {
    const Point along = normalised(b - a);
    const double size = length(b - a);
    if (size <= 2 * tolerance()) return;
    std::vector<double> cuts{0, size};
    const double low = std::min(a.x, b.x) - tolerance(), high = std::max(a.x, b.x) + tolerance();
    const auto first =
        std::lower_bound(corners.begin(), corners.end(), low, [](const Point& p, double x) { return p.x < x; });
    for (auto p = first; p != corners.end() && p->x <= high; ++p) {
      const double at = dot(*p - a, along);
      if (at > tolerance() && at < size - tolerance() && length(*p - a - at * along) <= tolerance()) cuts.push_back(at);
    }
    std::sort(cuts.begin(), cuts.end());
    for (size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (cuts[i + 1] - cuts[i] <= 2 * tolerance()) continue;
      const Point from = a + cuts[i] * along, to = a + cuts[i + 1] * along;
      meetingPoint({{from, to}, 0.5 * (from + to)});
    }
  }

  /// Adds a feature that is a corner of a portal or a part of a portal's edge, unless a void cell also touches the
  /// feature. (A portal is a face that two solid cells share.)
  void meetingPoint(Feature feature) {
    for (const GrownPiece& piece : pieces_)
      if (covers(piece.sides, feature)) {
        features_.push_back(std::move(feature));
        return;
      }
    std::vector<uint32_t> meeting;
    const std::pair point{feature.middle, feature.middle};
    for (uint32_t c = 0; c < cells_.cells.size(); ++c) {
      if (!boxesMeet(boxes_[c], point, 2 * tolerance())) continue;
      bool holds = true;
      for (const Side side : cells_.cells[c].sides)
        holds = holds && cells_.sidePlane(side).distance(feature.middle) <= tolerance();
      if (!holds) continue;
      if (!cells_.cells[c].solid) return;
      meeting.push_back(c);
    }
    const Point middle = feature.middle;
    if (!meeting.empty()) addFeature(std::move(feature), sidesAt(meeting, middle));
  }

  /// Removes redundant pieces. The last pieces cover the smallest features, so they are tried first.
  void dropSuperfluous() {
    std::vector<uint32_t> count(features_.size(), 0);
    for (GrownPiece& piece : pieces_)
      for (uint32_t f = 0; f < features_.size(); ++f)
        if (covers(piece.sides, features_[f])) {
          piece.covers.push_back(f);
          ++count[f];
        }
    for (size_t i = pieces_.size(); i-- > 0;) {
      const std::vector<uint32_t>& covers = pieces_[i].covers;
      // Keep a piece that covers no feature according to covers(): it is very thin, but was added because some feature
      // needs it.
      if (covers.empty() || !std::all_of(covers.begin(), covers.end(), [&](uint32_t f) { return count[f] > 1; }))
        continue;
      for (const uint32_t f : covers) --count[f];
      pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  ConvexPiece finished(const std::vector<Side>& sides) const {
    ConvexPiece piece;
    for (const Side side : sides) {
      PieceSide out;
      out.plane = cells_.sidePlane(side);
      out.number = 2 * side.plane + (side.before ? 1 : 0);
      out.material = materialOf(side, sides);
      piece.push_back(out);
    }
    std::sort(piece.begin(), piece.end(), [](const PieceSide& a, const PieceSide& b) { return a.number < b.number; });
    return piece;
  }

  /// Returns the material for a side of a convex piece: the material of the polyhedron's faces in that side's plane. If
  /// there are several materials, it is the one with the largest area within the piece.
  uint32_t materialOf(Side side, const std::vector<Side>& sides) const {
    // for each material, two areas of its faces: within the piece, and in the whole plane
    std::map<uint32_t, std::pair<double, double>> areas;
    for (const uint32_t t : triangles_[2 * side.plane + (side.before ? 1 : 0)]) {
      const uint32_t face = solid_.face_of[t];
      const auto& corners = solid_.triangles[t];
      Loop loop{solid_.points[corners[0]], solid_.points[corners[1]], solid_.points[corners[2]]};
      auto& area = areas[solid_.faces[face].material];
      area.second += areaOf(loop);
      for (const Side& other : sides)
        if (!(other == side)) loop = clippedLoop(loop, cells_.sidePlane(other), tolerance());
      if (loop.size() >= 3) area.first += areaOf(loop);
    }
    uint32_t best = kNoMaterial;
    std::pair<double, double> most{-1, -1};
    for (const auto& [material, area] : areas) {
      if (area <= most) continue;
      most = area;
      best = material;
    }
    return best;
  }

  const Polyhedron& solid_;
  const BspCells& cells_;
  const CoverLimits& limits_;
  std::vector<std::pair<Point, Point>> boxes_;  ///< bounding box of each cell
  std::vector<uint32_t> void_;                  ///< indices of the void cells
  /// for each half-space of each plane: the void cells in it, as indices into void_
  std::vector<std::vector<uint32_t>> outside_;
  /// for each plane and direction: the polyhedron's triangles in that plane that face in that direction
  std::vector<std::vector<uint32_t>> triangles_;
  std::vector<Feature> features_;
  std::vector<Loop> portals_;
  std::vector<GrownPiece> pieces_;
};

}  // namespace

Result<std::vector<ConvexPiece>> coverWithPieces(const Polyhedron& solid, const CoverLimits& limits) {
  const Result<BspCells> cells = cutIntoCells(solid, limits.cells);
  if (!cells) return cells.error();
  return CoverFinder(solid, *cells, limits).run();
}

}  // namespace sgm::asset
