#include "measure/measure_chunk.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "mesh/feature_kind.h"
#include "mesh/triangle_faults.h"
#include "mesh/vertex.h"

namespace sgm::measure {
namespace {

constexpr int kEnd = kChunkCells * kSubcell;
constexpr size_t kSide = kChunkSamples;
// higher bits of MeasureScratch::planes. kLeftOut: the vertex is excluded; kIsFeature: it is a feature vertex
constexpr uint8_t kLeftOut = 1 << 6, kIsFeature = 1 << 7;

bool isWithin(const Vertex& v, int lo, int hi) {
  return std::min({v.x, v.y, v.z}) >= lo && std::max({v.x, v.y, v.z}) <= hi;
}

uint8_t planesOfEdge(const Vertex& v) {
  if (v.x % kEnd != 0 && v.y % kEnd != 0 && v.z % kEnd != 0) return 0;
  return static_cast<uint8_t>((v.x == 0) | (v.x == kEnd) << 1 | (v.y == 0) << 2 | (v.y == kEnd) << 3 | (v.z == 0) << 4 |
                              (v.z == kEnd) << 5);
}

/// A face vertex is a feature vertex that belongs to a cell face. If this cell face lies in a border plane of the
/// chunk, returns the plane's bit (1 << Face); the vertex itself may lie off the plane. Returns 0 otherwise, also for
/// any other kind of feature vertex.
uint8_t planesOfFeature(const Vertex& v) {
  if ((v.kind & kFeatureOfCell) != 0) return 0;
  const int axis = v.kind >> 6 & 3, at = axis == 0 ? v.x : axis == 1 ? v.y : v.z;
  const int cell = (at >> 8) - ((v.kind >> 2 * axis & 3) - 1);
  return static_cast<uint8_t>(((cell == 0) | (cell == kChunkCells) << 1) << 2 * axis);
}

bool samePlace(const Vertex& a, const Vertex& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

void store(const TermSums& sums, PartMeasures& part) {
  part.area = sums.area;
  part.cross = {sums.x, sums.y, sums.z};
  part.six_volumes = sums.six_volumes;
  part.slivers = sums.slivers;
}

class BodyMeasurer {
 public:
  BodyMeasurer(const PartView& body, std::span<const uint64_t> signs, MeasureScratch& scratch, ChunkMeasures& measures)
      : body_(body),
        signs_(signs),
        scratch_(scratch),
        part_(measures.parts[0]),
        topology_(measures.topology),
        planes_(scratch.planes),
        directions_(scratch.directions),
        indices_(scratch.indices) {
    planes_.resize(body.vertices.size());
    directions_.resize(body.vertices.size());
    part_ = {};
    topology_ = {};
    part_.vertices = static_cast<uint32_t>(body.vertices.size());
    part_.triangles = static_cast<uint32_t>(body.indices.size() / 3);
  }

  void run() {
    lookAtVertices();
    if (!signs_.empty()) compareWithSamples();
    addTriangles();
    if (features_ > 0) joinFeatures();
    const StarCounts stars = countStars(indices_, planes_, scratch_.stars);
    topology_.vertices = stars.vertices;
    topology_.edges = stars.edges;
    topology_.triangles = static_cast<uint32_t>(indices_.size() / 3);
    topology_.border_edges = stars.border_edges;
    count(Defect::duplicate) = stars.duplicate_triangles;
    count(Defect::open_edge) = stars.open_edges;
    count(Defect::turned_edge) = stars.turned_edges;
    count(Defect::nonmanifold_edge) = stars.nonmanifold_edges;
    count(Defect::pinched_vertex) = stars.pinched_vertices;
    const PairCounts pairs = countPairs(scratch_.corners, scratch_.pairs);
    count(Defect::folded) = pairs.folded;
    count(Defect::self_intersection) = pairs.cut;
  }

 private:
  uint32_t& count(Defect kind) { return part_.defects[static_cast<size_t>(kind)]; }

  void lookAtVertices() {
    int last_edge = -1;
    for (size_t i = 0; i < body_.vertices.size(); ++i) {
      const Vertex& v = body_.vertices[i];
      directions_[i] = unfoldNormal(v.normal_x, v.normal_y);
      if (isFeature(v.kind)) {
        const bool within = isWithin(v, kLeastPosition, kMaxPosition);
        count(Defect::outside) += !within;
        planes_[i] = static_cast<uint8_t>(kIsFeature | (within ? planesOfFeature(v) : kLeftOut));
        ++features_;
      } else if (isWithin(v, 0, kEnd)) {
        const bool off_x = (v.x & 255) != 0, off_y = (v.y & 255) != 0, off_z = (v.z & 255) != 0;
        const int edge = (((v.z >> 8) * kChunkSamples + (v.y >> 8)) * kChunkSamples + (v.x >> 8)) * 3 + (off_x   ? 0
                                                                                                         : off_y ? 1
                                                                                                                 : 2);
        count(Defect::misplaced) += off_x + off_y + off_z != 1 || v.kind != kOwnEdge || edge <= last_edge;
        last_edge = edge;
        planes_[i] = planesOfEdge(v);
      } else {
        ++count(Defect::outside);
        planes_[i] = kLeftOut;
      }
    }
  }

  /// Returns the number of edges that start in a row of samples and whose ends differ in sign.
  uint32_t crossedEdges(size_t row) const {
    const bool y_ends = row % kSide == kChunkCells, z_ends = row / kSide == kChunkCells;
    const uint64_t signs = signs_[row], cells = (uint64_t{1} << kChunkCells) - 1;
    const uint64_t x = (signs ^ signs >> 1) & cells, y = y_ends ? 0 : signs ^ signs_[row + 1],
                   z = z_ends ? 0 : signs ^ signs_[row + kSide];
    return (x | y | z) == 0 ? 0 : static_cast<uint32_t>(std::popcount(x) + std::popcount(y) + std::popcount(z));
  }

  bool isOnCrossed(const SampleEdge& edge) const {
    // a misplaced vertex: it lies exactly on a sample in the upper face, where no edge along z starts
    if (edge.axis == 2 && edge.z == kChunkCells) return false;
    const auto row = static_cast<size_t>(edge.y) + kSide * static_cast<size_t>(edge.z);
    const uint64_t from = signs_[row] >> edge.x;
    const uint64_t to = edge.axis == 0   ? from >> 1
                        : edge.axis == 1 ? signs_[row + 1] >> edge.x
                                         : signs_[row + kSide] >> edge.x;
    return ((from ^ to) & 1) != 0;
  }

  void compareWithSamples() {
    uint32_t on_crossed = 0, crossed = 0;
    for (size_t i = 0; i < body_.vertices.size(); ++i) {
      if ((planes_[i] & (kLeftOut | kIsFeature)) != 0) continue;
      on_crossed += isOnCrossed(edgeOfBodyVertex(body_.vertices[i]));
      ++topology_.compared;
    }
    for (size_t row = 0; row < signs_.size(); ++row) crossed += crossedEdges(row);
    // Counts the vertices on uncrossed edges, and the crossed edges without a vertex. Assumes that each edge has at
    // most one vertex: a second one was counted as misplaced.
    count(Defect::unlike_samples) = topology_.compared - on_crossed + (crossed > on_crossed ? crossed - on_crossed : 0);
  }

  void addTriangles() {
    indices_.resize(3 * size_t{part_.triangles});
    scratch_.corners.resize(3 * size_t{part_.triangles});
    // Sums are accumulated in a local variable: it cannot alias the data that is read, so the compiler keeps it in
    // registers.
    TermSums sums;
    uint32_t against = 0, flat = 0, degenerate = 0;
    uint32_t* kept = indices_.data();
    PairCorner* corner = scratch_.corners.data();
    const Vertex* const vertices = body_.vertices.data();
    const uint8_t* const planes = planes_.data();
    const PackedDirection* const directions = directions_.data();
    const uint32_t first_vertex = body_.first_vertex, count_vertices = part_.vertices;
    for (size_t at = 0; at + 3 <= body_.indices.size(); at += 3) {
      const uint32_t a = body_.indices[at] - first_vertex, b = body_.indices[at + 1] - first_vertex,
                     c = body_.indices[at + 2] - first_vertex;
      if (std::max({a, b, c}) >= count_vertices) {
        ++count(Defect::index);
        continue;
      }
      const unsigned marks = planes[a] | planes[b] | planes[c];
      if ((marks & kLeftOut) != 0) continue;
      const TriangleTerms terms = termsOf(vertices[a], vertices[b], vertices[c]);
      addTerms(terms, sums);
      if (terms.square == 0) {
        const bool in_one = samePlace(vertices[a], vertices[b]) || samePlace(vertices[b], vertices[c]) ||
                            samePlace(vertices[c], vertices[a]);
        ++(in_one ? degenerate : flat);
        if (a == b || b == c || c == a) continue;
      } else {
        against += !facesAlong(terms, directions[a], directions[b], directions[c]);
        for (const uint32_t v : {a, b, c}) *corner++ = {vertices[v].x, vertices[v].y, vertices[v].z, vertices[v].kind};
      }
      kept[0] = a;
      kept[1] = b;
      kept[2] = c;
      kept += 3;
    }
    indices_.resize(static_cast<size_t>(kept - indices_.data()));
    scratch_.corners.resize(static_cast<size_t>(corner - scratch_.corners.data()));
    store(sums, part_);
    part_.against_gradient = against;
    count(Defect::flat) = flat;
    count(Defect::degenerate) = degenerate;
  }

  /// Joins feature vertices that splitCreases() has duplicated: they have equal position and kind, and so an equal key.
  void joinFeatures() {
    const size_t slots = std::bit_ceil(2 * features_);
    constexpr uint32_t kFree = UINT32_MAX;
    std::pmr::vector<uint32_t>&table = scratch_.table, &first = scratch_.first;
    table.assign(slots, kFree);
    first.resize(body_.vertices.size());
    const auto word = [&](size_t i) {
      const Vertex& v = body_.vertices[i];
      return uint64_t{static_cast<uint16_t>(v.x)} | uint64_t{static_cast<uint16_t>(v.y)} << 16 |
             uint64_t{static_cast<uint16_t>(v.z)} << 32 | uint64_t{v.kind} << 48;
    };
    for (uint32_t i = 0; i < first.size(); ++i) {
      first[i] = i;
      if ((planes_[i] & kIsFeature) == 0) continue;
      // Fibonacci hashing: the upper bits of the product are well mixed.
      size_t slot = static_cast<size_t>((word(i) * 0x9E3779B97F4A7C15u) >> 32) & (slots - 1);
      while (table[slot] != kFree && word(table[slot]) != word(i)) slot = (slot + 1) & (slots - 1);
      if (table[slot] == kFree) table[slot] = i;
      first[i] = table[slot];
    }
    for (uint32_t& index : indices_) index = first[index];
    dropDegenerate();
  }

  void dropDegenerate() {
    size_t kept = 0;
    for (size_t at = 0; at < indices_.size(); at += 3) {
      const uint32_t a = indices_[at], b = indices_[at + 1], c = indices_[at + 2];
      // A triangle whose corners coincide after joining is dropped: it was counted as degenerate before.
      if (a == b || b == c || c == a) continue;
      indices_[kept++] = a;
      indices_[kept++] = b;
      indices_[kept++] = c;
    }
    indices_.resize(kept);
  }

  const PartView body_;
  const std::span<const uint64_t> signs_;
  MeasureScratch& scratch_;
  PartMeasures& part_;
  BodyTopology& topology_;
  std::pmr::vector<uint8_t>& planes_;
  std::pmr::vector<PackedDirection>& directions_;
  std::pmr::vector<uint32_t>& indices_;
  size_t features_ = 0;
};

}  // namespace

PartView viewOf(const PackedMesh& mesh, size_t part) {
  const PackedRange& range = mesh.ranges[part];
  return {std::span(mesh.vertices).subspan(range.first_vertex, range.vertex_count),
          std::span(mesh.indices).subspan(range.first_index, range.index_count), range.first_vertex};
}

void measureBody(const PartView& body, std::span<const uint64_t> signs, MeasureScratch& scratch,
                 ChunkMeasures& measures) {
  BodyMeasurer(body, signs, scratch, measures).run();
}

PartMeasures measureSeam(const PartView& seam) {
  PartMeasures part;
  part.vertices = static_cast<uint32_t>(seam.vertices.size());
  part.triangles = static_cast<uint32_t>(seam.indices.size() / 3);
  const auto outside = [](const Vertex& v) {
    return isFeature(v.kind) ? !isWithin(v, kLeastPosition, kMaxPosition) : !isWithin(v, 0, kEnd);
  };
  part.defects[static_cast<size_t>(Defect::outside)] =
      static_cast<uint32_t>(std::count_if(seam.vertices.begin(), seam.vertices.end(), outside));
  TermSums sums;
  for (size_t at = 0; at + 3 <= seam.indices.size(); at += 3) {
    const uint32_t a = seam.indices[at] - seam.first_vertex, b = seam.indices[at + 1] - seam.first_vertex,
                   c = seam.indices[at + 2] - seam.first_vertex;
    if (std::max({a, b, c}) >= part.vertices) {
      ++part.defects[static_cast<size_t>(Defect::index)];
      continue;
    }
    const Vertex &u = seam.vertices[a], &v = seam.vertices[b], &w = seam.vertices[c];
    if (outside(u) || outside(v) || outside(w)) continue;
    const auto areOne = [](uint32_t i, uint32_t j, const Vertex& p, const Vertex& q) {
      return i == j || (samePlace(p, q) && !maySharePlace(p.kind, q.kind));
    };
    part.defects[static_cast<size_t>(Defect::degenerate)] +=
        areOne(a, b, u, v) || areOne(b, c, v, w) || areOne(c, a, w, u);
    addTerms(termsOf(u, v, w), sums);
  }
  store(sums, part);
  return part;
}

}  // namespace sgm::measure
