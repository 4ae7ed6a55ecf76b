#include "measure/self_intersection.h"

#include <algorithm>

#include "measure/triangle_pair.h"

namespace sgm::measure {

SelfIntersections selfIntersections(const Triangles& mesh, const Bvh& tree, uint64_t most_tests, JobSystem& jobs) {
  constexpr size_t kParts = 256;
  const std::vector<Bvh::Pair> parts = tree.parts(kParts);
  const uint64_t most = std::max<uint64_t>(most_tests / parts.size(), 1);
  std::vector<SelfIntersections> found(parts.size());
  parallelFor(jobs, parts.size(), [&](size_t part) {
    SelfIntersections& here = found[part];
    uint64_t tests = 0;
    tree.visitPairs(parts[part], [&](uint32_t a, uint32_t b) {
      here.complete = tests < most;
      ++tests;
      if (!here.complete) return false;
      if (meetWrongly(mesh.points, mesh.triangles[a], mesh.triangles[b])) {
        ++here.pairs;
        if (here.examples.size() < kMostExamples) here.examples.push_back(std::minmax(a, b));
      }
      return true;
    });
  });
  SelfIntersections all;
  for (const SelfIntersections& part : found) {
    all.pairs += part.pairs;
    all.complete = all.complete && part.complete;
    all.examples.insert(all.examples.end(), part.examples.begin(), part.examples.end());
  }
  std::sort(all.examples.begin(), all.examples.end());
  all.examples.resize(std::min(all.examples.size(), kMostExamples));
  return all;
}

}  // namespace sgm::measure
