#include "mesh/check.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "mesh/key_order.h"

namespace sgm {
namespace {

/// A triangle as seen from one of its vertices: the two other vertices, in the triangle's order.
struct Corner {
  uint32_t next, previous;
};

/// The corners of all triangles that are not degenerate, grouped by vertex.
struct CornersByVertex {
  std::pmr::vector<size_t> start;
  std::pmr::vector<Corner> corners;

  CornersByVertex(std::span<const uint32_t> indices, size_t vertex_count, size_t& degenerate,
                  std::pmr::memory_resource* memory)
      : start(vertex_count + 1, memory), corners(memory) {
    const auto each = [&](auto&& visit) {
      for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
        if (a == b || b == c || c == a) continue;
        visit(a, b, c);
        visit(b, c, a);
        visit(c, a, b);
      }
    };
    size_t count = 0;
    each([&](uint32_t v, uint32_t, uint32_t) { ++start[v + 1], ++count; });
    degenerate = indices.size() / 3 - count / 3;
    for (size_t v = 0; v < vertex_count; ++v) start[v + 1] += start[v];
    corners.resize(count);
    std::pmr::vector<size_t> next(start.begin(), start.end() - 1, start.get_allocator());
    each([&](uint32_t v, uint32_t b, uint32_t c) { corners[next[v]++] = {b, c}; });
  }

  std::span<const Corner> around(size_t v) const { return {corners.data() + start[v], start[v + 1] - start[v]}; }
};

/// Counts the edges from v to vertices of higher number only, so that each edge of the mesh is counted once.
void countEdges(size_t v, std::span<const Corner> around, std::vector<uint32_t>& out, std::vector<uint32_t>& in,
                MeshReport& report) {
  out.clear();
  in.clear();
  for (const Corner& c : around) {
    if (c.next > v) out.push_back(c.next);
    if (c.previous > v) in.push_back(c.previous);
  }
  std::sort(out.begin(), out.end());
  std::sort(in.begin(), in.end());
  for (size_t i = 0, j = 0; i < out.size() || j < in.size();) {
    const uint32_t other = i < out.size() && (j >= in.size() || out[i] <= in[j]) ? out[i] : in[j];
    size_t forward = 0, backward = 0;
    for (; i < out.size() && out[i] == other; ++i) ++forward;
    for (; j < in.size() && in[j] == other; ++j) ++backward;
    ++report.edges;
    report.open_edges += forward + backward == 1;
    report.unmatched_edges += forward != backward;
    report.repeated_edges += forward > 1 || backward > 1;
    report.non_manifold_edges += forward + backward > 2;
  }
}

/// Counts duplicate triangles, each at the vertex of lowest number among its three.
void countDuplicates(size_t v, std::span<const Corner> around, std::vector<std::pair<uint32_t, uint32_t>>& opposite,
                     MeshReport& report) {
  opposite.clear();
  for (const Corner& c : around)
    if (c.next > v && c.previous > v) opposite.push_back(std::minmax(c.next, c.previous));
  std::sort(opposite.begin(), opposite.end());
  for (size_t i = 1; i < opposite.size(); ++i) report.duplicate_triangles += opposite[i] == opposite[i - 1];
}

enum class Link { cycle, path, broken };

/// Classifies the link of a vertex. link: the triangles around the vertex; this function sorts them by `next`. In the
/// link, triangle a is followed by the triangle b with b.next == a.previous.
Link classifyLink(std::vector<Corner>& link) {
  std::sort(link.begin(), link.end(), [](const Corner& a, const Corner& b) { return a.next < b.next; });
  const auto find = [&](uint32_t from) {
    const auto at =
        std::lower_bound(link.begin(), link.end(), from, [](const Corner& c, uint32_t n) { return c.next < n; });
    return at != link.end() && at->next == from ? static_cast<size_t>(at - link.begin()) : link.size();
  };
  for (size_t i = 1; i < link.size(); ++i)
    if (link[i].next == link[i - 1].next) return Link::broken;
  // Marks each triangle that follows another triangle in the link. If the link is a path, all triangles but the first
  // are marked; if it is a cycle, all are.
  std::vector<bool> led_to(link.size());
  for (const Corner& c : link) {
    const size_t to = find(c.previous);
    if (to == link.size()) continue;
    if (led_to[to]) return Link::broken;
    led_to[to] = true;
  }
  const size_t start = static_cast<size_t>(std::find(led_to.begin(), led_to.end(), false) - led_to.begin());
  const bool path = start < link.size();
  size_t seen = 0, at = path ? start : 0;
  do {
    ++seen;
    at = find(link[at].previous);
  } while (at != link.size() && (path || at != 0));
  if (seen != link.size()) return Link::broken;
  return path ? Link::path : Link::cycle;
}

}  // namespace

MeshReport checkTriangles(std::span<const uint32_t> indices, size_t vertex_count, std::pmr::memory_resource* memory) {
  MeshReport report;
  report.triangles = indices.size() / 3;
  const CornersByVertex mesh(indices, vertex_count, report.degenerate_triangles, memory);
  std::vector<uint32_t> out, in;
  std::vector<std::pair<uint32_t, uint32_t>> opposite;
  std::vector<Corner> link;
  for (size_t v = 0; v < vertex_count; ++v) {
    const std::span<const Corner> around = mesh.around(v);
    if (around.empty()) continue;
    ++report.vertices;
    countEdges(v, around, out, in, report);
    countDuplicates(v, around, opposite, report);
    link.assign(around.begin(), around.end());
    const Link kind = classifyLink(link);
    report.border_vertices += kind == Link::path;
    report.pinched_vertices += kind == Link::broken;
  }
  return report;
}

MeshReport checkParts(std::span<const MeshPart* const> parts) {
  std::vector<OrderedKey> keys;
  size_t indices_count = 0;
  for (const MeshPart* part : parts) {
    for (const VertexKey& key : part->keys) keys.emplace_back(key, static_cast<uint32_t>(keys.size()));
    indices_count += part->indices.size();
  }
  std::sort(keys.begin(), keys.end());
  std::vector<uint32_t> number(keys.size());
  uint32_t next = 0;
  for (size_t i = 0; i < keys.size(); ++i) {
    if (i > 0 && !keys[i].sameKey(keys[i - 1])) ++next;
    number[keys[i].place] = next;
  }
  std::vector<uint32_t> indices;
  indices.reserve(indices_count);
  size_t first = 0;
  for (const MeshPart* part : parts) {
    for (uint32_t index : part->indices) indices.push_back(number[first + index]);
    first += part->keys.size();
  }
  return checkTriangles(indices, keys.empty() ? 0 : size_t{next} + 1);
}

std::string describe(const MeshReport& r) {
  const std::pair<const char*, size_t> counts[] = {{"triangles", r.triangles},
                                                   {"vertices", r.vertices},
                                                   {"edges", r.edges},
                                                   {"open edges", r.open_edges},
                                                   {"unmatched edges", r.unmatched_edges},
                                                   {"repeated edges", r.repeated_edges},
                                                   {"non-manifold edges", r.non_manifold_edges},
                                                   {"non-manifold vertices", r.pinched_vertices},
                                                   {"border vertices", r.border_vertices},
                                                   {"degenerate triangles", r.degenerate_triangles},
                                                   {"duplicate triangles", r.duplicate_triangles}};
  std::string text;
  for (const auto& [name, count] : counts) {
    if (count == 0) continue;
    if (!text.empty()) text += ", ";
    text += std::to_string(count) + ' ' + name;
  }
  return text.empty() ? "no triangles" : text;
}

}  // namespace sgm
