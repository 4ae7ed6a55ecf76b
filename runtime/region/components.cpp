#include "region/components.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <tuple>
#include <utility>

namespace sgm {
namespace {

constexpr uint32_t kUnseen = std::numeric_limits<uint32_t>::max();

/// Returns the index of the first sample from x on whose sign differs from `solid`; nx if there is none.
size_t endOfRun(const uint64_t* row, size_t x, size_t nx, bool solid) {
  while (x < nx) {
    const uint64_t other = (solid ? ~row[x / 64] : row[x / 64]) >> (x % 64);
    if (other != 0) return std::min(nx, x + static_cast<size_t>(std::countr_zero(other)));
    x = (x / 64 + 1) * 64;
  }
  return nx;
}

void add(Piece& piece, const Piece& part) {
  piece.samples += part.samples;
  piece.box = piece.box.joined(part.box);
}

/// Returns true if piece a precedes piece b in the order of Pieces.
bool before(const Piece& a, const Piece& b) {
  const Int3 l = a.box.lo, r = b.box.lo;
  return std::tie(a.samples, l.z, l.y, l.x) < std::tie(b.samples, r.z, r.y, r.x);
}

}  // namespace

ComponentCounter::ComponentCounter(size_t nx, size_t ny, std::pmr::memory_resource* memory)
    : nx_(nx), ny_(ny), last_(memory), next_(memory), parent_(memory), number_(memory), pieces_(memory) {}

void ComponentCounter::findRuns(std::span<const uint64_t> signs) {
  next_.runs.clear();
  next_.first.clear();
  const size_t words = rowWords(nx_);
  for (size_t y = 0; y < ny_; ++y) {
    next_.first.push_back(next_.runs.size());
    const uint64_t* row = signs.data() + y * words;
    bool solid = row[0] & 1;
    for (size_t x = 0; x < nx_; solid = !solid) {
      const size_t end = endOfRun(row, x, nx_, solid);
      next_.runs.push_back({static_cast<uint32_t>(x), static_cast<uint32_t>(end),
                            open_ + static_cast<uint32_t>(next_.runs.size()), solid});
      x = end;
    }
  }
  next_.first.push_back(next_.runs.size());
  const size_t pieces = size_t{open_} + next_.runs.size();
  parent_.resize(pieces);
  for (size_t i = 0; i < pieces; ++i) parent_[i] = static_cast<uint32_t>(i);
}

uint32_t ComponentCounter::rootOf(uint32_t piece) {
  while (parent_[piece] != piece) {
    parent_[piece] = parent_[parent_[piece]];
    piece = parent_[piece];
  }
  return piece;
}

void ComponentCounter::join(uint32_t a, uint32_t b) {
  a = rootOf(a);
  b = rootOf(b);
  if (a < b) std::swap(a, b);
  parent_[a] = b;
}

void ComponentCounter::joinRows(std::span<const Run> a, std::span<const Run> b, uint32_t diagonal, bool solid) {
  size_t first = 0;
  for (const Run& run : a) {
    if (run.solid && !solid) continue;
    while (first < b.size() && b[first].end + diagonal <= run.begin) ++first;
    for (size_t i = first; i < b.size() && b[i].begin < run.end + diagonal; ++i) {
      if (b[i].solid != run.solid) continue;
      const bool over = b[i].begin < run.end && run.begin < b[i].end;
      if (over || !run.solid) join(run.piece, b[i].piece);
    }
  }
}

void ComponentCounter::retire() {
  number_.assign(parent_.size(), kUnseen);
  uint32_t kept = 0;
  std::pmr::vector<Open> pieces(pieces_.get_allocator());
  for (size_t y = 0; y < ny_; ++y) {
    for (size_t i = next_.first[y]; i < next_.first[y + 1]; ++i) {
      Run& run = next_.runs[i];
      uint32_t& number = number_[rootOf(run.piece)];
      if (number == kUnseen) {
        number = kept++;
        pieces.push_back({run.solid, {}});
      }
      run.piece = number;
      const auto row = static_cast<int32_t>(y);
      const IntBox box{{static_cast<int32_t>(run.begin), row, planes_},
                       {static_cast<int32_t>(run.end) - 1, row, planes_}};
      add(pieces[number].piece, {run.end - run.begin, box});
    }
  }
  for (uint32_t i = 0; i < open_; ++i) {
    // Only runs of the new plane can still connect pieces. So a piece without a run in this plane is complete.
    const uint32_t number = number_[rootOf(i)];
    if (number != kUnseen) {
      add(pieces[number].piece, pieces_[i].piece);
    } else {
      (pieces_[i].solid ? closed_.solid : closed_.air).push_back(pieces_[i].piece);
    }
  }
  ++planes_;
  open_ = kept;
  pieces_ = std::move(pieces);
  std::swap(last_, next_);
}

void ComponentCounter::addPlane(std::span<const uint64_t> signs) {
  findRuns(signs);
  for (size_t y = 0; y < ny_; ++y) {
    if (y > 0) joinRows(next_.row(y), next_.row(y - 1), 1, true);
    if (last_.first.empty()) continue;
    joinRows(next_.row(y), last_.row(y), 1, true);
    if (y > 0) joinRows(next_.row(y), last_.row(y - 1), 0, false);
    if (y + 1 < ny_) joinRows(next_.row(y), last_.row(y + 1), 0, false);
  }
  retire();
}

Pieces ComponentCounter::pieces() const {
  Pieces all = closed_;
  for (const Open& open : pieces_) (open.solid ? all.solid : all.air).push_back(open.piece);
  std::sort(all.solid.begin(), all.solid.end(), before);
  std::sort(all.air.begin(), all.air.end(), before);
  return all;
}

std::span<const Piece> largerThan(std::span<const Piece> pieces, double samples) {
  const auto first = std::partition_point(pieces.begin(), pieces.end(), [samples](const Piece& piece) {
    return static_cast<double>(piece.samples) <= samples;
  });
  return {first, pieces.end()};
}

Components Pieces::above(double samples) const {
  return {largerThan(solid, samples).size(), largerThan(air, samples).size()};
}

}  // namespace sgm
