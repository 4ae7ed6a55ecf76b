#include "derive/layout/wave_collapse.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <queue>
#include <tuple>

#include "base/hash.h"

namespace sgm {
namespace {

/// The number of choices that the first search may undo before it restarts.
constexpr uint64_t kFirstRetreats = 32;
/// Divisor in the cost of a visit, that is, of updating the neighbours of one place (propagate()). In units of
/// WaveResult::work, a visit costs L * W / kLabelsOfVisit, but at least 1. L: number of labels that the tiles use;
/// W: number of 64-bit words of a TileSet.
constexpr uint64_t kLabelsOfVisit = 8;

constexpr size_t facing(size_t side) { return side < 4 ? (side + 2) % 4 : 9 - side; }

/// The tiles that are still possible at a place, one bit each.
template <size_t kWords>
struct TileSet {
  std::array<uint64_t, kWords> word{};

  friend bool operator==(const TileSet&, const TileSet&) = default;
  bool empty() const { return *this == TileSet(); }
  bool meets(const TileSet& other) const {
    uint64_t both = 0;
    for (size_t w = 0; w < kWords; ++w) both |= word[w] & other.word[w];
    return both != 0;
  }
  void keep(const TileSet& other) {
    for (size_t w = 0; w < kWords; ++w) word[w] &= other.word[w];
  }
  void add(const TileSet& other) {
    for (size_t w = 0; w < kWords; ++w) word[w] |= other.word[w];
  }
  void set(size_t tile) { word[tile / 64] |= uint64_t{1} << tile % 64; }
  void reset(size_t tile) { word[tile / 64] &= ~(uint64_t{1} << tile % 64); }
  uint32_t count() const {
    int sum = 0;
    for (const uint64_t w : word) sum += std::popcount(w);
    return static_cast<uint32_t>(sum);
  }
  template <class Visit>
  void each(const Visit& visit) const {
    for (size_t w = 0; w < kWords; ++w)
      for (uint64_t left = word[w]; left != 0; left &= left - 1)
        visit(w * 64 + static_cast<size_t>(std::countr_zero(left)));
  }
};

template <size_t kWords>
class TileSearch {
  using Tiles = TileSet<kWords>;

 public:
  TileSearch(std::span<const WaveTile> tiles, const WaveLattice& lattice, uint64_t key, uint64_t max_visits,
             size_t max_bytes)
      : tiles_(tiles), lattice_(lattice), key_(key), max_visits_(max_visits), max_bytes_(max_bytes) {
    WaveLabels used = 0;
    for (const WaveTile& tile : tiles)
      for (const WaveLabels labels : tile.sides) used |= labels;
    for (; used != 0; used &= used - 1) labels_.push_back(static_cast<uint8_t>(std::countr_zero(used)));
    Tiles all;
    for (size_t t = 0; t < tiles.size(); ++t) {
      all.set(t);
      for (size_t side = 0; side < kWaveSides; ++side)
        for (WaveLabels left = tiles[t].sides[side]; left != 0; left &= left - 1)
          with_[side][static_cast<size_t>(std::countr_zero(left))].set(t);
    }
    const auto& n = lattice.size;
    domains_.assign(size_t{n[0]} * n[1] * n[2], all);
    failures_.assign(domains_.size(), 0);
    waits_.assign(domains_.size(), false);
  }

  WaveResult run() {
    WaveResult out;
    uint64_t retreats = 0, max_retreats = kFirstRetreats;
    bool sound = begin();
    while (true) {
      if (spent_) {
        out.end = WaveEnd::gave_up;
        break;
      }
      if (!sound) {
        if (choices_.empty()) {
          out.end = WaveEnd::impossible;
          break;
        }
        if (++retreats > max_retreats) {
          // Undoes all choices, but keeps what was proven before the first choice.
          undo(choices_[0].changes);
          choices_.clear();
          retreats = 0;
          max_retreats *= 2;
          ++attempt_;
          sound = true;
          continue;
        }
        const Choice wrong = choices_.back();
        choices_.pop_back();
        undo(wrong.changes);
        Tiles rest = domains_[wrong.place];
        rest.reset(wrong.tile);
        sound = narrow(wrong.place, rest) && propagate();
        continue;
      }
      const uint32_t place = next();
      if (place == kNoPlace) break;
      const size_t tile = draw(place);
      choices_.push_back({changes_.size(), place, static_cast<uint16_t>(tile)});
      Tiles one;
      one.set(tile);
      sound = narrow(place, one) && propagate();
    }
    out.visits = visits_;
    out.work = visits_ * std::max<uint64_t>(1, labels_.size() * kWords / kLabelsOfVisit);
    if (out.end != WaveEnd::solved) {
      out.place = hardest_;
      out.wanted = wanted_;
      return out;
    }
    for (const Tiles& domain : domains_) domain.each([&](size_t t) { out.tiles.push_back(static_cast<uint16_t>(t)); });
    return out;
  }

 private:
  struct Change {
    uint32_t place;
    Tiles before;
  };
  struct Choice {
    size_t changes;  ///< number of changes that were made before the choice
    uint32_t place;
    uint16_t tile;
  };
  /// An entry of the queue of places: urgency(place), a random number that breaks ties, and the place. The entry is
  /// stale if the place's urgency has changed.
  using Waiting = std::tuple<uint32_t, uint32_t, uint32_t>;

  std::optional<uint32_t> neighbour(uint32_t place, size_t side) const {
    const auto& n = lattice_.size;
    const uint32_t x = place % n[0], y = place / n[0] % n[1], z = place / n[0] / n[1];
    switch (side) {
      case 0:
        return z + 1 < n[2] ? std::optional(place + n[0] * n[1]) : std::nullopt;
      case 1:
        return x + 1 < n[0] ? std::optional(place + 1) : std::nullopt;
      case 2:
        return z > 0 ? std::optional(place - n[0] * n[1]) : std::nullopt;
      case 3:
        return x > 0 ? std::optional(place - 1) : std::nullopt;
      case 4:
        return y + 1 < n[1] ? std::optional(place + n[0]) : std::nullopt;
      default:
        return y > 0 ? std::optional(place - n[0]) : std::nullopt;
    }
  }

  /// Removes the tiles that do not match the border. Then removes the tiles that match no tile of some neighbouring
  /// place. Visits each place at least once.
  bool begin() {
    spent_ = max_visits_ < domains_.size();
    if (spent_) return false;
    for (uint32_t place = 0; place < domains_.size(); ++place) {
      Tiles fits = domains_[place];
      for (size_t side = 0; side < kWaveSides; ++side) {
        if (neighbour(place, side)) continue;
        Tiles beside;
        for (const uint8_t label : labels_)
          if ((lattice_.border[side] >> label & 1) != 0) beside.add(with_[side][label]);
        fits.keep(beside);
      }
      if (!narrow(place, fits)) return false;
      ask(place);
    }
    return propagate();
  }

  size_t bytes() const { return changes_.size() * sizeof(Change) + waiting_.size() * sizeof(Waiting); }

  void ask(uint32_t place) {
    if (waits_[place]) return;
    waits_[place] = true;
    asked_.push_back(place);
  }

  uint32_t urgency(uint32_t place) const { return (domains_[place].count() << 16) / (1 + failures_[place]); }

  void wait(uint32_t place) {
    if (domains_[place].count() < 2) return;
    waiting_.emplace(urgency(place), static_cast<uint32_t>(hashCombine(key_ + attempt_, place) >> 32), place);
  }

  /// Restricts a place to a set of tiles; returns false if the set is empty.
  bool narrow(uint32_t place, const Tiles& to) {
    if (to == domains_[place]) return true;
    changes_.push_back({place, domains_[place]});
    domains_[place] = to;
    if (to.empty()) {
      fail(place);
      return false;
    }
    ask(place);
    return true;
  }

  void fail(uint32_t place) {
    for (const uint32_t other : asked_) waits_[other] = false;
    asked_.clear();
    failures_[place] = std::min(failures_[place] + 1, 0xFFFFu);
    if (hardest_ != kNoPlace && failures_[place] < failures_[hardest_]) return;
    hardest_ = place;
    for (size_t side = 0; side < kWaveSides; ++side) {
      const std::optional<uint32_t> other = neighbour(place, side);
      wanted_[side] = other ? 0 : lattice_.border[side];
      if (!other) continue;
      for (const uint8_t label : labels_)
        if (domains_[*other].meets(with_[facing(side)][label])) wanted_[side] |= WaveLabels{1} << label;
    }
  }

  /// Removes tiles from the neighbours of the changed places until all sides can match. Two sides match if they have a
  /// label in common, so it is enough to know the labels that a place still offers: no table of tile pairs is needed.
  bool propagate() {
    for (size_t next_asked = 0; next_asked < asked_.size(); ++next_asked) {
      if (visits_ == max_visits_ || bytes() > max_bytes_) {
        spent_ = true;
        return false;
      }
      const uint32_t place = asked_[next_asked];
      waits_[place] = false;
      ++visits_;
      for (size_t side = 0; side < kWaveSides; ++side) {
        const std::optional<uint32_t> other = neighbour(place, side);
        if (!other) continue;
        Tiles fits;
        for (const uint8_t label : labels_)
          if (domains_[place].meets(with_[side][label])) fits.add(with_[facing(side)][label]);
        fits.keep(domains_[*other]);
        if (!narrow(*other, fits)) return false;
      }
    }
    // asked_ contains every changed place; a place that changed again after its visit is contained more than once.
    for (const uint32_t place : asked_) wait(place);
    asked_.clear();
    return true;
  }

  void undo(size_t changes) {
    while (changes_.size() > changes) {
      const Change& last = changes_.back();
      domains_[last.place] = last.before;
      wait(last.place);
      changes_.pop_back();
    }
  }

  /// Returns the place with the fewest possible tiles relative to its number of past failures; kNoPlace if every place
  /// has one tile.
  uint32_t next() {
    while (!waiting_.empty()) {
      const auto [urgent, tie, place] = waiting_.top();
      waiting_.pop();
      if (domains_[place].count() > 1 && urgent == urgency(place)) return place;
    }
    return kNoPlace;
  }

  size_t draw(uint32_t place) const {
    uint64_t total = 0;
    domains_[place].each([&](size_t t) { total += tiles_[t].weight; });
    // The random number has 32 bits, so that its product with the sum of weights fits in 64 bits.
    uint64_t left = (hashCombine(hashCombine(key_ + attempt_, place), 1) >> 32) * total >> 32;
    size_t drawn = tiles_.size();
    domains_[place].each([&](size_t t) {
      if (drawn < tiles_.size()) return;
      if (left < tiles_[t].weight) drawn = t;
      left -= tiles_[t].weight;
    });
    return drawn;
  }

  std::span<const WaveTile> tiles_;
  const WaveLattice& lattice_;
  uint64_t key_, max_visits_;
  size_t max_bytes_;
  uint64_t attempt_ = 0, visits_ = 0;
  bool spent_ = false;           ///< true: the limit of visits, or of memory, is exceeded
  std::vector<uint8_t> labels_;  ///< indices of the labels that any tile uses
  /// with_[side][label]: the tiles that have this label on this side
  std::array<std::array<Tiles, 64>, kWaveSides> with_;
  std::vector<Tiles> domains_;
  std::vector<uint32_t> failures_;
  std::vector<uint32_t> asked_;  ///< queue of places whose neighbours must be visited
  std::vector<bool> waits_;      ///< for each place: true if it waits in asked_
  std::vector<Change> changes_;
  std::vector<Choice> choices_;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting_;
  uint32_t hardest_ = kNoPlace;
  std::array<WaveLabels, kWaveSides> wanted_{};
};

}  // namespace

WaveResult collapseWave(std::span<const WaveTile> tiles, const WaveLattice& lattice, uint64_t key, uint64_t max_visits,
                        size_t max_bytes) {
  // Most tile sets have at most 64 tiles, for which one word per set is faster.
  if (tiles.size() <= 64) return TileSearch<1>(tiles, lattice, key, max_visits, max_bytes).run();
  return TileSearch<4>(tiles, lattice, key, max_visits, max_bytes).run();
}

}  // namespace sgm
