#include "stream/void_path.h"

#include <algorithm>
#include <cmath>

#include "grammar/sink.h"
#include "stream/void_walk.h"

namespace sgm {

namespace {

constexpr uint64_t kMostChunks = uint64_t{1} << 24;  // whatever the caller allows
constexpr int kMostNeed = kMostClearance * kMostClearance;
constexpr int kRadiiTogether = 16;      // sizes of agents that one look at the region tells apart
constexpr size_t kChunksTogether = 64;  // chunks whose voids are there before they are joined

/// An end of a way: its sample, if it has one, and how far that is from what is solid.
struct End {
  std::optional<Int3> sample;
  int clearance = 0;  ///< squared, in cells
};

/// What one look finds for agents of one size.
struct Look {
  int need = 1;  ///< square of the clearance, in cells, that makes a sample free
  VoidGraph graph;
  std::array<std::optional<uint32_t>, 2> ends{};  ///< the voids that the ends lie in

  bool joined() { return ends[0] && ends[1] && graph.joined(*ends[0], *ends[1]); }
};

class VoidSearch {
 public:
  VoidSearch(const SignField& field, JobSystem& jobs, const VoidQuestion& question, const Progress& progress)
      : field_(field), jobs_(jobs), question_(question), progress_(progress), window_(field) {}

  Result<VoidAnswer> run() {
    if (const Result<void> ok = setUp(); !ok) return ok.error();
    VoidAnswer answer;
    answer.extent = {unitsAt(firstSample(low_)), unitsAt(firstSample(high_))};
    answer.chunks = static_cast<uint64_t>(count_.x) * static_cast<uint64_t>(count_.y) * static_cast<uint64_t>(count_.z);
    const double edge = metres(field_.cell);
    answer.sample = edge * edge * edge;
    if (question_.ends) {
      for (size_t i = 0; i < 2; ++i) {
        const Result<End> end = endAt(i == 0 ? question_.ends->from : question_.ends->to);
        if (!end) return end.error();
        ends_[i] = *end;
      }
      first_failing_ = std::min(ends_[0].clearance, ends_[1].clearance) + 1;
    }
    const int need = needed();
    std::vector<int> needs = question_.ends && question_.ends->widest ? between() : std::vector<int>();
    needs.push_back(need);
    Result<std::vector<Look>> looks = look(std::move(needs), need);
    if (!looks) return looks.error();
    const auto asked = std::find_if(looks->begin(), looks->end(), [&](const Look& l) { return l.need == need; });
    answer.voids = asked->graph.voids();
    if (!question_.ends) return answer;
    Result<VoidWay> way = wayIn(*asked);
    if (!way) return way.error();
    if (question_.ends->widest) {
      if (const Result<void> ok = narrow(*looks); !ok) return ok.error();
      way->widest = std::sqrt(static_cast<double>(last_holding_)) * field_.cell;
    }
    answer.way = std::move(*way);
    return answer;
  }

 private:
  static Int3 firstSample(Int3 chunk) { return {chunk.x * kChunkCells, chunk.y * kChunkCells, chunk.z * kChunkCells}; }
  Int3 unitsAt(Int3 sample) const { return {sample.x * field_.cell, sample.y * field_.cell, sample.z * field_.cell}; }

  Result<void> setUp() {
    const double most = double{kMostClearance} * field_.cell;
    if (!(question_.radius >= 0 && question_.radius < most)) {
      return Error{Code::invalid_argument, "the radius is not a number from 0 to less than " +
                                               std::to_string(kMostClearance) + " cells, " +
                                               numberText(most / kUnitsPerMetre) + " m"};
    }
    const int64_t edge = int64_t{kChunkCells} * field_.cell;
    const uint64_t most_chunks = std::min(question_.max_chunks, kMostChunks);
    uint64_t chunks = 1;
    for (int axis = 0; axis < 3; ++axis) {
      if (question_.region.lo[axis] >= question_.region.hi[axis])
        return Error{Code::invalid_argument, "the region is empty"};
      const int64_t low = floorDiv(question_.region.lo[axis], edge);
      const int64_t high = floorDiv(int64_t{question_.region.hi[axis]} - 1, edge) + 1;
      if ((low - 1) * edge < INT32_MIN || (high + 1) * edge > INT32_MAX)
        return Error{Code::range, "the region, with one chunk around it, leaves the world"};
      low_[axis] = static_cast<int32_t>(low);
      high_[axis] = static_cast<int32_t>(high);
      count_[axis] = high_[axis] - low_[axis];
      chunks = std::min(chunks * static_cast<uint64_t>(count_[axis]), most_chunks + 1);
    }
    if (chunks > most_chunks) {
      return Error{Code::limit, "the region has more than " + std::to_string(most_chunks) +
                                    " chunks; make the cells larger or the region smaller, or raise the limit"};
    }
    return {};
  }

  /// The chunk that owns a sample of the region.
  Int3 chunkOf(Int3 sample) const {
    Int3 chunk;
    for (int axis = 0; axis < 3; ++axis)
      chunk[axis] = std::min(static_cast<int32_t>(floorDiv(sample[axis], kChunkCells)), high_[axis] - 1);
    return chunk;
  }
  static Int3 localIn(Int3 chunk, Int3 sample) {
    const Int3 first = firstSample(chunk);
    return {sample.x - first.x, sample.y - first.y, sample.z - first.z};
  }

  Result<End> endAt(const std::array<double, 3>& place) {
    Int3 low;
    for (int axis = 0; axis < 3; ++axis) {
      const double units = place[static_cast<size_t>(axis)];
      if (!std::isfinite(units)) return Error{Code::invalid_argument, "an end of the way is not finite"};
      const double first = double{kChunkCells} * field_.cell * low_[axis];
      const double last = double{kChunkCells} * field_.cell * high_[axis];
      if (!(units >= first && units <= last))
        return Error{Code::invalid_argument, "an end of the way lies outside of the region"};
      const double sample = std::floor(units / field_.cell);
      low[axis] = std::min(static_cast<int32_t>(sample), high_[axis] * kChunkCells - 1);
    }
    // All eight lie in one chunk.
    const Int3 chunk = chunkOf(low);
    if (const Result<void> added = window_.add(chunksAround(chunk, 1), jobs_); !added) return added.error();
    const std::pmr::vector<uint16_t> clearance = window_.clearance(chunk, kMostNeed);
    End end;
    double nearest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Int3 sample{low.x + (corner & 1), low.y + (corner >> 1 & 1), low.z + (corner >> 2)};
      const Int3 local = localIn(chunk, sample);
      const int here = clearance[static_cast<size_t>(local.x + kChunkSamples * (local.y + kChunkSamples * local.z))];
      double square = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double away = place[static_cast<size_t>(axis)] - static_cast<double>(field_.cell) * sample[axis];
        square += away * away;
      }
      if (here == 0 || (end.sample && square >= nearest)) continue;
      nearest = square;
      end = {sample, here};
    }
    return end;
  }

  /// The least square that is more than the radius's: what is as near as that is in the way.
  int needed() const {
    const double cells = question_.radius / field_.cell;
    return std::min(static_cast<int>(std::floor(cells * cells)) + 1, kMostNeed);
  }

  /// Needs between the last that is known to have a way and the first that is known to have none, evenly, ascending.
  std::vector<int> between() const {
    const int open = first_failing_ - last_holding_ - 1, picked = std::min(open, kRadiiTogether);
    std::vector<int> needs;
    for (int i = 1; i <= picked; ++i) needs.push_back(last_holding_ + static_cast<int>(int64_t{open} * i / picked));
    return needs;
  }

  /// What one look for all these needs finds, in ascending order; ways are kept for one of them.
  Result<std::vector<Look>> look(std::vector<int> needs, int way) {
    std::sort(needs.begin(), needs.end());
    needs.erase(std::unique(needs.begin(), needs.end()), needs.end());
    std::vector<Look> looks;
    for (const int need : needs) looks.push_back({need, VoidGraph(count_, need == way, field_.memory)});
    const int rings = needs.back() > 1 ? 1 : 0;
    const uint64_t in_layer = static_cast<uint64_t>(count_.x) * static_cast<uint64_t>(count_.y);
    for (int32_t z = low_.z; z < high_.z; ++z) {
      window_.dropUnless([&](Int3 chunk) { return std::abs(chunk.z - z) <= rings; });
      std::vector<Int3> seen, layer;
      for (int32_t dz = -rings; dz <= rings; ++dz) {
        for (int32_t y = low_.y - rings; y < high_.y + rings; ++y) {
          for (int32_t x = low_.x - rings; x < high_.x + rings; ++x) seen.push_back({x, y, z + dz});
        }
      }
      if (const Result<void> added = window_.add(seen, jobs_); !added) return added.error();
      for (int32_t y = low_.y; y < high_.y; ++y) {
        for (int32_t x = low_.x; x < high_.x; ++x) layer.push_back({x, y, z});
      }
      const uint64_t done = in_layer * static_cast<uint64_t>(z - low_.z);
      if (const Result<void> ok = addLayer(layer, looks, done); !ok) return ok.error();
    }
    return looks;
  }

  Result<void> addLayer(std::span<const Int3> layer, std::vector<Look>& looks, uint64_t done) {
    const uint64_t total = static_cast<uint64_t>(count_.z) * layer.size();
    for (size_t first = 0; first < layer.size(); first += kChunksTogether) {
      const std::span<const Int3> some = layer.subspan(first, std::min(kChunksTogether, layer.size() - first));
      std::vector<std::vector<ChunkVoids>> voids(some.size());
      parallelFor(jobs_, some.size(), [&](size_t i) { voids[i] = voidsOf(some[i], looks); });
      for (size_t i = 0; i < some.size(); ++i) {
        for (size_t l = 0; l < looks.size(); ++l) {
          const std::vector<std::optional<uint32_t>> marked = voids[i][l].marked;
          if (!looks[l].graph.add(std::move(voids[i][l])))
            return Error{Code::limit, "the region has more than 2^32 voids; ask in parts"};
          size_t mark = 0;
          for (size_t end = 0; end < 2; ++end) {
            if (!owns(some[i], end)) continue;
            const std::optional<uint32_t> v = marked[mark++];
            if (v) looks[l].ends[end] = looks[l].graph.numberOf(*v);
          }
        }
        if (progress_ && !progress_(++done, total) && done < total)
          return Error{Code::cancelled, "the search for voids was cancelled"};
      }
    }
    return {};
  }

  bool owns(Int3 chunk, size_t end) const { return ends_[end].sample && chunkOf(*ends_[end].sample) == chunk; }

  std::vector<ChunkVoids> voidsOf(Int3 chunk, const std::vector<Look>& looks) const {
    const std::pmr::vector<uint16_t> clearance = window_.clearance(chunk, looks.back().need);
    Int3 owned;
    for (int axis = 0; axis < 3; ++axis) owned[axis] = kChunkCells + (chunk[axis] + 1 == high_[axis] ? 1 : 0);
    std::vector<Int3> marks;
    for (size_t end = 0; end < 2; ++end) {
      if (owns(chunk, end)) marks.push_back(localIn(chunk, *ends_[end].sample));
    }
    std::vector<ChunkVoids> voids;
    for (const Look& l : looks) voids.push_back(chunkVoids(rowsBelow(clearance, l.need), owned, marks, field_.memory));
    return voids;
  }

  /// Looks until the largest need that has a way is known.
  Result<void> narrow(std::vector<Look>& looks) {
    learn(looks);
    for (std::vector<int> needs = between(); !needs.empty(); needs = between()) {
      Result<std::vector<Look>> more = look(std::move(needs), 0);
      if (!more) return more.error();
      learn(*more);
    }
    return {};
  }

  void learn(std::vector<Look>& looks) {
    for (Look& l : looks) {
      if (l.joined()) {
        last_holding_ = std::max(last_holding_, l.need);
      } else {
        first_failing_ = std::min(first_failing_, l.need);
      }
    }
  }

  Result<VoidWay> wayIn(Look& asked) {
    VoidWay way;
    way.from_clearance = std::sqrt(static_cast<double>(ends_[0].clearance)) * field_.cell;
    way.to_clearance = std::sqrt(static_cast<double>(ends_[1].clearance)) * field_.cell;
    if (asked.ends[0]) way.from_samples = asked.graph.samplesOf(*asked.ends[0]);
    if (asked.ends[1]) way.to_samples = asked.graph.samplesOf(*asked.ends[1]);
    way.verdict = !ends_[0].sample   ? WayVerdict::from_in_rock
                  : !ends_[1].sample ? WayVerdict::to_in_rock
                  : !asked.ends[0]   ? WayVerdict::from_too_narrow
                  : !asked.ends[1]   ? WayVerdict::to_too_narrow
                  : asked.joined()   ? WayVerdict::found
                                     : WayVerdict::apart;
    if (way.verdict != WayVerdict::found) return way;
    const Int3 from = *ends_[0].sample, to = *ends_[1].sample;
    std::vector<Int3> chunks;
    for (const uint32_t number :
         asked.graph.chunksOfWay(*asked.ends[0], localIn(low_, from), *asked.ends[1], localIn(low_, to))) {
      const auto x = static_cast<uint32_t>(count_.x), y = static_cast<uint32_t>(count_.y);
      chunks.push_back({low_.x + static_cast<int32_t>(number % x), low_.y + static_cast<int32_t>(number / x % y),
                        low_.z + static_cast<int32_t>(number / x / y)});
    }
    Result<std::vector<Int3>> walk = shortestWalk(window_, jobs_, chunks, from, to, asked.need, field_.memory);
    if (!walk) return walk.error();
    way.length = lengthOf(*walk) * field_.cell;
    way.places = std::move(*walk);
    for (Int3& place : way.places) place = unitsAt(place);
    return way;
  }

  const SignField& field_;
  JobSystem& jobs_;
  const VoidQuestion& question_;
  const Progress& progress_;
  SignWindow window_;
  Int3 low_, high_, count_;  ///< chunks; high_ does not belong to the region
  std::array<End, 2> ends_;
  int last_holding_ = 0;   ///< needs up to this have a way
  int first_failing_ = 1;  ///< needs from this on have none
};

}  // namespace

Result<VoidAnswer> findVoids(const SignField& field, JobSystem& jobs, const VoidQuestion& question,
                             const Progress& progress) {
  return VoidSearch(field, jobs, question, progress).run();
}

}  // namespace sgm
