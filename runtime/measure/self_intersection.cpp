#include "measure/self_intersection.h"

#include <algorithm>
#include <mutex>

#include "measure/triangle_pair.h"

namespace sgm::measure {

SelfIntersections selfIntersections(const Triangles& mesh, const Bvh& tree, uint64_t max_steps, JobSystem& jobs,
                                    const MeasureProgress& progress) {
  constexpr size_t kParts = 256;
  struct Part {
    Bvh::Walk walk;
    SelfIntersections found;
    uint64_t steps = 0;
  };
  std::vector<Part> parts;
  for (const Bvh::Pair& pair : tree.parts(kParts)) parts.push_back({Bvh::Walk(pair), {}, 0});
  std::mutex mutex;
  uint64_t done = 0;
  // The search works in rounds. In each round, every unfinished part of the search gets an equal share of the remaining
  // steps. The unused steps of a part go to the others in the next round, so the result does not depend on the speed of
  // threads.
  uint64_t left = max_steps;
  for (;;) {
    std::vector<Part*> open;
    for (Part& part : parts)
      if (!part.walk.ended()) open.push_back(&part);
    const uint64_t share = open.empty() ? 0 : left / open.size();
    if (share == 0) break;
    parallelFor(jobs, open.size(), [&](size_t i) {
      Part& part = *open[i];
      part.steps = tree.visitPairs(part.walk, share, [&](uint32_t a, uint32_t b) -> uint64_t {
        const PairFault fault = pairFault(mesh.points, mesh.triangles[a], mesh.triangles[b]);
        if (fault == PairFault::none) return 0;
        const bool folded = fault == PairFault::folded;
        ++part.found.pairs;
        part.found.folded += folded;
        auto& examples = folded ? part.found.folded_examples : part.found.examples;
        if (examples.size() < kMaxExamples) examples.push_back(std::minmax(a, b));
        return kStepsAPair - 1;
      });
      if (!progress || !part.walk.ended()) return;
      const std::lock_guard lock(mutex);
      progress(++done, parts.size());
    });
    for (const Part* part : open) left -= std::min(left, part->steps);
  }
  SelfIntersections all;
  for (const Part& part : parts) {
    all.pairs += part.found.pairs;
    all.folded += part.found.folded;
    all.complete = all.complete && part.walk.ended();
    all.examples.insert(all.examples.end(), part.found.examples.begin(), part.found.examples.end());
    all.folded_examples.insert(all.folded_examples.end(), part.found.folded_examples.begin(),
                               part.found.folded_examples.end());
  }
  for (auto* examples : {&all.examples, &all.folded_examples}) {
    std::sort(examples->begin(), examples->end());
    examples->resize(std::min(examples->size(), kMaxExamples));
  }
  return all;
}

}  // namespace sgm::measure
