#include "query/void_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "grammar/text/sink.h"
#include "query/void_walk.h"
#include "world/fitting_cell.h"

namespace sgm {

namespace {

constexpr int kMaxNeed = kMaxClearance * kMaxClearance;
constexpr int kRadiiTogether = 16;  // number of agent sizes that one pass over the region distinguishes
// number of chunks whose voids are computed in parallel before they are added to the graph
constexpr size_t kChunksTogether = 64;

/// One end of a path: the sample where it begins or ends (nullopt if the end lies in rock), and its distance from the
/// solid.
struct End {
  std::optional<Int3> sample;
  int clearance = 0;  ///< squared distance from `sample` to the nearest solid sample, in cells
};

/// The result of one pass over the region for agents of one size.
struct Survey {
  int need = 1;  ///< a sample is free if the square of its clearance, in cells, is at least this number
  VoidGraph graph;
  std::array<std::optional<uint32_t>, 2> ends{};  ///< index of the void that contains each end of the path; nullopt if
                                                  ///< an end lies in no void

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
        const Result<End> end = i == 0 ? endAt("from", question_.ends->from) : endAt("to", question_.ends->to);
        if (!end) return end.error();
        ends_[i] = *end;
      }
      first_failing_ = std::min(ends_[0].clearance, ends_[1].clearance) + 1;
    }
    const int need = needed();
    std::vector<int> needs = question_.ends && question_.ends->widest ? between() : std::vector<int>();
    needs.push_back(need);
    Result<std::vector<Survey>> looks = look(std::move(needs), need);
    if (!looks) return looks.error();
    const auto asked = std::find_if(looks->begin(), looks->end(), [&](const Survey& l) { return l.need == need; });
    answer.voids = asked->graph.voids();
    if (!question_.ends) return answer;
    Result<VoidWay> way = wayIn(*asked);
    if (!way) return way.error();
    if (question_.ends->widest) {
      if (const Result<void> ok = narrow(*looks); !ok) return ok.error();
      way->widest = leastAsFar(last_holding_);
    }
    answer.way = std::move(*way);
    return answer;
  }

 private:
  static Int3 firstSample(Int3 chunk) { return {chunk.x * kChunkCells, chunk.y * kChunkCells, chunk.z * kChunkCells}; }
  Int3 unitsAt(Int3 sample) const { return {sample.x * field_.cell, sample.y * field_.cell, sample.z * field_.cell}; }

  Result<void> setUp() {
    const double most = double{kMaxClearance} * field_.cell;
    if (!(question_.radius >= 0 && question_.radius < most)) {
      return Error{Code::invalid_argument, "the radius is not a number from 0 to less than " +
                                               std::to_string(kMaxClearance) + " cells, " +
                                               numberText(most / kUnitsPerMetre) + " m"};
    }
    const int64_t edge = int64_t{kChunkCells} * field_.cell;
    const uint64_t max_chunks = std::min(question_.max_chunks, kMaxRegionChunks);
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
      chunks = std::min(chunks * static_cast<uint64_t>(count_[axis]), max_chunks + 1);
    }
    if (chunks > max_chunks) {
      return Error{Code::limit, "the region has more than " + std::to_string(max_chunks) +
                                    " chunks; make the cells larger" +
                                    fittingCellText({&question_.region, 1}, 0, field_.cell, max_chunks) +
                                    " or the region smaller, or raise the limit"};
    }
    return {};
  }

  /// Returns the chunk that owns a sample of the region.
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

  /// Formats a place for an error message: x, y, z in the unit that the caller uses.
  std::string told(const std::array<double, 3>& place) const {
    const double unit = question_.ends->tell_metres ? kUnitsPerMetre : 1;
    return numberText(place[0] / unit) + ", " + numberText(place[1] / unit) + ", " + numberText(place[2] / unit);
  }

  Result<End> endAt(const char* name, const std::array<double, 3>& place) {
    std::array<double, 3> first{}, last{};
    bool finite = true, inside = true;
    for (size_t axis = 0; axis < 3; ++axis) {
      first[axis] = double{kChunkCells} * field_.cell * low_[static_cast<int>(axis)];
      last[axis] = double{kChunkCells} * field_.cell * high_[static_cast<int>(axis)];
      finite = finite && std::isfinite(place[axis]);
      inside = inside && place[axis] >= first[axis] && place[axis] <= last[axis];
    }
    const std::string end_of = std::string("the end `") + name + "` of the path ";
    if (!finite) return Error{Code::invalid_argument, end_of + "is not finite"};
    if (!inside) {
      return Error{Code::invalid_argument, end_of + "lies outside of the region: it is at (" + told(place) +
                                               "), but the region goes from (" + told(first) + ") to (" + told(last) +
                                               "), in " +
                                               (question_.ends->tell_metres ? "metres" : "units of 1/1024 m")};
    }
    Int3 low;
    for (int axis = 0; axis < 3; ++axis) {
      const double sample = std::floor(place[static_cast<size_t>(axis)] / field_.cell);
      low[axis] = std::min(static_cast<int32_t>(sample), high_[axis] * kChunkCells - 1);
    }
    // The eight samples around a place always lie in one chunk: adjacent chunks both contain the samples in their
    // common face.
    const Int3 chunk = chunkOf(low);
    if (const Result<void> added = window_.add(chunksAround(chunk, 1), jobs_); !added) return added.error();
    const std::pmr::vector<uint16_t> clearance = window_.clearance(chunk, kMaxNeed);
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

  /// True if a distance, given by its square in cells, is at most a length in units. All code compares distances with
  /// this function, so that a length which the search reports gives the same result when it is used in another query.
  bool isAsNear(int square, double length) const { return length * length >= squaredOf(square); }
  double squaredOf(int square) const { return static_cast<double>(field_.cell) * field_.cell * square; }

  /// Returns the clearance that the agent needs: the smallest squared distance to a solid sample, in cells, that
  /// exceeds the square of the agent's radius. A sample with at least this clearance is free.
  int needed() const {
    int need = 1;
    while (need < kMaxNeed && isAsNear(need, question_.radius)) ++need;
    return need;
  }

  /// Returns the smallest length in units that counts as at least the distance whose square, in cells, is `square`. The
  /// comparison is that of isAsNear(), so the result is the square root or a floating-point number next to it.
  double leastAsFar(int square) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    double least = std::sqrt(squaredOf(square));
    while (!isAsNear(square, least)) least = std::nextafter(least, kInfinity);
    for (double less = least; square > 0 && isAsNear(square, less); less = std::nextafter(less, -kInfinity))
      least = less;
    return least;
  }

  /// Returns the values of `need` that the next pass tries, ascending and evenly spaced. They lie above the largest
  /// value that is known to have a path, and below the smallest value that is known to have none.
  std::vector<int> between() const {
    const int open = first_failing_ - last_holding_ - 1, picked = std::min(open, kRadiiTogether);
    std::vector<int> needs;
    for (int i = 1; i <= picked; ++i) needs.push_back(last_holding_ + static_cast<int>(int64_t{open} * i / picked));
    return needs;
  }

  /// Makes one pass over the region for several values of `need`. Returns one result per value, in ascending order of
  /// need. way: the value of `need` whose graph also stores the data for finding a path; 0: no graph stores them.
  Result<std::vector<Survey>> look(std::vector<int> needs, int way) {
    std::sort(needs.begin(), needs.end());
    needs.erase(std::unique(needs.begin(), needs.end()), needs.end());
    const ChunkOrder order(count_);
    std::vector<Survey> looks;
    for (const int need : needs) looks.push_back({need, VoidGraph(order, need == way, field_.memory)});
    const int rings = needs.back() > 1 ? 1 : 0;
    for (uint64_t first = 0; first < order.size(); first += kChunksTogether) {
      std::vector<Int3> some, seen;
      for (uint64_t number = first; number < std::min(first + kChunksTogether, order.size()); ++number) {
        some.push_back(chunkNumber(order, number));
        const std::vector<Int3> around = chunksAround(some.back(), rings);
        seen.insert(seen.end(), around.begin(), around.end());
      }
      window_.dropUnless([&](Int3 chunk) {
        // The voids of a chunk depend on the signs of the chunks around it. `last` is the last chunk, in the order of
        // processing, whose voids depend on `chunk`.
        Int3 last;
        for (int axis = 0; axis < 3; ++axis)
          last[axis] = std::clamp(chunk[axis] + rings - low_[axis], 0, count_[axis] - 1);
        return order.numberOf(last) >= first;
      });
      if (const Result<void> added = window_.add(seen, jobs_); !added) return added.error();
      if (const Result<void> ok = addChunks(some, looks, first, order.size()); !ok) return ok.error();
    }
    return looks;
  }

  Int3 chunkNumber(const ChunkOrder& order, uint64_t number) const {
    const Int3 chunk = order.at(number);
    return {low_.x + chunk.x, low_.y + chunk.y, low_.z + chunk.z};
  }

  Result<void> addChunks(std::span<const Int3> some, std::vector<Survey>& looks, uint64_t done, uint64_t total) {
    std::vector<std::vector<ChunkVoids>> voids(some.size());
    parallelFor(jobs_, some.size(), [&](size_t i) { voids[i] = voidsOf(some[i], looks); });
    for (size_t i = 0; i < some.size(); ++i) {
      for (size_t l = 0; l < looks.size(); ++l) {
        const std::vector<std::optional<uint32_t>> marked = voids[i][l].marked;
        if (!looks[l].graph.add(std::move(voids[i][l])))
          return Error{Code::limit, "the region has more than 2^32 voids; split it"};
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
    return {};
  }

  bool owns(Int3 chunk, size_t end) const { return ends_[end].sample && chunkOf(*ends_[end].sample) == chunk; }

  std::vector<ChunkVoids> voidsOf(Int3 chunk, const std::vector<Survey>& looks) const {
    const std::pmr::vector<uint16_t> clearance = window_.clearance(chunk, looks.back().need);
    Int3 owned;
    for (int axis = 0; axis < 3; ++axis) owned[axis] = kChunkCells + (chunk[axis] + 1 == high_[axis] ? 1 : 0);
    std::vector<Int3> marks;
    for (size_t end = 0; end < 2; ++end) {
      if (owns(chunk, end)) marks.push_back(localIn(chunk, *ends_[end].sample));
    }
    std::vector<ChunkVoids> voids;
    for (const Survey& l : looks)
      voids.push_back(chunkVoids(rowsBelow(clearance, l.need), owned, marks, field_.memory));
    return voids;
  }

  /// Makes further passes over the region until the largest value of `need` that has a path is known.
  Result<void> narrow(std::vector<Survey>& looks) {
    learn(looks);
    for (std::vector<int> needs = between(); !needs.empty(); needs = between()) {
      Result<std::vector<Survey>> more = look(std::move(needs), 0);
      if (!more) return more.error();
      learn(*more);
    }
    return {};
  }

  void learn(std::vector<Survey>& looks) {
    for (Survey& l : looks) {
      if (l.joined()) {
        last_holding_ = std::max(last_holding_, l.need);
      } else {
        first_failing_ = std::min(first_failing_, l.need);
      }
    }
  }

  Result<VoidWay> wayIn(Survey& asked) {
    VoidWay way;
    way.from_clearance = leastAsFar(ends_[0].clearance);
    way.to_clearance = leastAsFar(ends_[1].clearance);
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
    const ChunkOrder order(count_);
    std::vector<Int3> chunks;
    for (const uint32_t number :
         asked.graph.chunksOfWay(*asked.ends[0], localIn(low_, from), *asked.ends[1], localIn(low_, to)))
      chunks.push_back(chunkNumber(order, number));
    Result<std::vector<Int3>> walk =
        shortestWalk(window_, jobs_, chunks, from, to, asked.need, field_.memory, progress_);
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
  /// the region in chunks: low_ to high_ (excluded), and the number of chunks along each axis
  Int3 low_, high_, count_;
  std::array<End, 2> ends_;
  int last_holding_ = 0;   ///< the largest value of `need` that is known to have a path
  int first_failing_ = 1;  ///< the smallest value of `need` that is known to have no path
};

}  // namespace

Result<VoidAnswer> findVoids(const SignField& field, JobSystem& jobs, const VoidQuestion& question,
                             const Progress& progress) {
  return VoidSearch(field, jobs, question, progress).run();
}

}  // namespace sgm
