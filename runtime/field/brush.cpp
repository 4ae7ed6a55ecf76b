#include "field/brush.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "field/compile.h"

namespace sgm {

namespace {

Error badSize(const char* what, int64_t size, int32_t least) {
  return {Code::invalid_argument, "a brush's " + std::string(what) + " is " + std::to_string(size) +
                                      " units; it must be between " + std::to_string(least) + " and " +
                                      std::to_string(kMaxBrushSize) + " (1,024 m)"};
}

bool inside(int64_t size, int32_t least) { return size >= least && size <= kMaxBrushSize; }

// Returns the rotation from world to local axes. The quaternion may have any length: products of its components are
// divided by its squared length, so that no square root is rounded.
Frame frameOf(const Brush& brush) {
  const double x = double{brush.turn[0]}, y = double{brush.turn[1]}, z = double{brush.turn[2]},
               w = double{brush.turn[3]};
  const double s = 2.0 / (x * x + y * y + z * z + w * w);
  const std::array<double, 9> to_world{1 - s * (y * y + z * z), s * (x * y - z * w),     s * (x * z + y * w),
                                       s * (x * y + z * w),     1 - s * (x * x + z * z), s * (y * z - x * w),
                                       s * (x * z - y * w),     s * (y * z + x * w),     1 - s * (x * x + y * y)};
  Frame frame;
  frame.origin = brush.from;
  for (size_t i = 0; i < 3; ++i) {
    // Adding 0 turns -0 into 0, so that equal frames have equal bits.
    for (size_t j = 0; j < 3; ++j) frame.rows[3 * i + j] = static_cast<float>(to_world[3 * j + i] + 0.0);
  }
  return frame;
}

struct Box64 {
  std::array<int64_t, 3> lo{}, hi{};
};

// Returns the bounds of the shape and its blend, plus a margin of one unit for float rounding.
Box64 bounds64(const Brush& brush) {
  std::array<int64_t, 3> reach{};
  reach.fill(brush.radius);
  if (brush.shape == Brush::Shape::box) {
    const Frame frame = frameOf(brush);
    for (size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (size_t row = 0; row < 3; ++row) {
        sum += std::abs(double{frame.rows[3 * row + axis]}) * brush.half[static_cast<int>(row)];
      }
      reach[axis] = static_cast<int64_t>(std::ceil(sum));
    }
  }
  Box64 box;
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<size_t>(i);
    const int32_t other = brush.shape == Brush::Shape::capsule ? brush.to[i] : brush.from[i];
    box.lo[axis] = std::min(brush.from[i], other) - reach[axis] - brush.smooth - 1;
    box.hi[axis] = std::max(brush.from[i], other) + reach[axis] + brush.smooth + 1;
  }
  return box;
}

Result<void> checkBox(const Brush& brush) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!inside(brush.half[axis], 1)) return badSize("half extent", brush.half[axis], 1);
  }
  double square = 0;
  for (float q : brush.turn) square += double{q} * double{q};
  if (!(square >= 1e-12 && square <= 1e12)) {
    return Error{Code::invalid_argument,
                 "a brush's turn is not a rotation: its quaternion's length is 0 or not a number"};
  }
  return {};
}

}  // namespace

Result<void> checkBrush(const Brush& brush) {
  if (brush.shape > Brush::Shape::capsule) {
    return Error{Code::invalid_argument, "a brush is a sphere, a box or a capsule"};
  }
  if (brush.shape == Brush::Shape::box) {
    if (Result<void> box = checkBox(brush); !box) return box;
  } else if (!inside(brush.radius, 1)) {
    return badSize("radius", brush.radius, 1);
  }
  if (!inside(brush.smooth, 0)) return badSize("smooth width", brush.smooth, 0);
  for (int axis = 0; axis < 3 && brush.shape == Brush::Shape::capsule; ++axis) {
    const int64_t length = std::abs(int64_t{brush.to[axis]} - brush.from[axis]);
    if (!inside(length, 0)) return badSize("length along an axis", length, 0);
  }
  const Box64 box = bounds64(brush);
  for (size_t axis = 0; axis < 3; ++axis) {
    if (box.lo[axis] < INT32_MIN || box.hi[axis] > INT32_MAX) {
      return Error{Code::range, "a brush leaves the world, which ends about 2,097 km from the origin"};
    }
  }
  return {};
}

IntBox brushBounds(const Brush& brush) {
  const Box64 box = bounds64(brush);
  return {{saturate(box.lo[0]), saturate(box.lo[1]), saturate(box.lo[2])},
          {saturate(box.hi[0]), saturate(box.hi[1]), saturate(box.hi[2])}};
}

bool brushShows(const Brush& brush, int32_t cell) {
  const int32_t half =
      brush.shape == Brush::Shape::box ? std::min({brush.half.x, brush.half.y, brush.half.z}) : brush.radius;
  return 2 * int64_t{half} >= cell;
}

Result<void> emitBrush(ProgramBuilder& builder, const Brush& brush, int32_t cell, uint32_t layer) {
  const uint32_t label = makeLabel(brush.material, brush.tag);
  const auto real = [](int32_t units) { return static_cast<float>(units); };
  Value root;
  switch (brush.shape) {
    case Brush::Shape::sphere:
      root = builder.sphere(brush.from, real(brush.radius), label);
      break;
    case Brush::Shape::box:
      root = builder.box(frameOf(brush), real(brush.half.x), real(brush.half.y), real(brush.half.z), label);
      break;
    case Brush::Shape::capsule:
      root = builder.capsule(brush.from, real(brush.to.x - brush.from.x), real(brush.to.y - brush.from.y),
                             real(brush.to.z - brush.from.z), real(brush.radius), label);
      break;
  }
  return builder.group(root, brushBounds(brush).grown(influenceMargin(cell)), layer, brush.cut, real(brush.smooth));
}

}  // namespace sgm
