#include "derive/interpret/lower_layers.h"

#include <algorithm>
#include <vector>

#include "base/math.h"

namespace sgm {

namespace {

/// Whether the ball intersects the box. The point of the box nearest to the ball's centre is found separately for each
/// coordinate.
bool meets(const Ball& ball, const IntBox& box) {
  uint64_t square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t near = std::clamp(ball.centre[axis], box.lo[axis], box.hi[axis]);
    const int64_t away = near - ball.centre[axis];
    square += static_cast<uint64_t>(away * away);
  }
  const auto radius = static_cast<uint64_t>(ball.radius);
  return square <= radius * radius;
}

IntBox onePosition(Int3 p) { return {p, p}; }

Int3 middleOf(const IntBox& box) {
  const auto half = [](int32_t lo, int32_t hi) { return static_cast<int32_t>(floorDiv(int64_t{lo} + hi, 2)); };
  return {half(box.lo.x, box.hi.x), half(box.lo.y, box.hi.y), half(box.lo.z, box.hi.z)};
}

/// Appends the eight octants of a box to `out`; fewer if an axis has only one position.
void halve(const IntBox& box, std::vector<IntBox>& out) {
  const Int3 middle = middleOf(box);
  for (int corner = 0; corner < 8; ++corner) {
    IntBox half = box;
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) == 0)
        half.hi[axis] = middle[axis];
      else
        half.lo[axis] = saturate(int64_t{middle[axis]} + 1);
    }
    if (!half.empty()) out.push_back(half);
  }
}

}  // namespace

BallProof proveBall(const Ball& ball, BoxContent wanted, const std::function<BoxContent(const IntBox&)>& content) {
  BallProof proof;
  if (ball.radius < 0) return proof;
  std::vector<IntBox> pieces{onePosition(ball.centre).grown(ball.radius)}, halves;
  for (int halving = 0;; ++halving) {
    halves.clear();
    for (const IntBox& piece : pieces) {
      if (!meets(ball, piece)) continue;
      if (++proof.pieces > kMaxBallPieces) return proof;
      const BoxContent found = content(piece);
      if (found == wanted) continue;
      if (found != BoxContent::unknown) return proof;
      // If the middle position of the piece lies in the ball and is not `wanted`, the proof has failed, and the search
      // ends early.
      const IntBox middle = onePosition(middleOf(piece));
      if (meets(ball, middle) && content(middle) != wanted) return proof;
      halve(piece, halves);
    }
    if (halves.empty()) {
      proof.holds = true;
      return proof;
    }
    if (halving == kBallHalvings) return proof;
    pieces.swap(halves);
  }
}

BallProof LowerLayers::prove(uint32_t layer, const Ball& ball, BoxContent wanted) const {
  return proveBall(ball, wanted, [&](const IntBox& box) {
    if (box.lo != box.hi) return BoxContent::unknown;
    return solid(layer, box.lo) ? BoxContent::solid : BoxContent::open;
  });
}

Int3 probePoint(Int3 from, std::array<double, 3> direction, int32_t t) {
  const auto along = [&](int32_t start, double d) {
    return saturate(start + static_cast<int64_t>(detFloor(d * t + 0.5)));
  };
  return {along(from.x, direction[0]), along(from.y, direction[1]), along(from.z, direction[2])};
}

std::optional<int32_t> LowerLayers::probe(uint32_t layer, Int3 from, std::array<double, 3> direction,
                                          int32_t length) const {
  if (length < 0 || solid(layer, from)) return std::nullopt;
  int32_t open = 0;
  while (open < length) {
    int32_t closed = open + std::min(kProbeStep, length - open);
    if (!solid(layer, probePoint(from, direction, closed))) {
      open = closed;
      continue;
    }
    while (closed - open > 1) {
      const int32_t middle = open + (closed - open) / 2;
      (solid(layer, probePoint(from, direction, middle)) ? closed : open) = middle;
    }
    return closed;
  }
  return std::nullopt;
}

}  // namespace sgm
