// Tests texture coordinates of shapes: they preserve lengths, are never mirrored, and close around closed shapes.

#include <cmath>
#include <random>

#include "base/math.h"
#include "catch.h"
#include "rounds.h"
#include "texture/texture_space.h"

using namespace sgm;

namespace {

double uniform(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
}

TexturePoint operator+(const TexturePoint& a, const TexturePoint& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
TexturePoint times(double s, const TexturePoint& a) { return {s * a[0], s * a[1], s * a[2]}; }
double lengthOf(const TexturePoint& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }
TexturePoint crossOf(const TexturePoint& a, const TexturePoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
TexturePoint unit(const TexturePoint& a) { return times(1 / lengthOf(a), a); }

TexturePoint randomDirection(std::mt19937& random) {
  for (;;) {
    const TexturePoint d{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
    if (lengthOf(d) > 0.1 && lengthOf(d) < 1) return unit(d);
  }
}

/// A randomly rotated frame.
Frame randomFrame(std::mt19937& random) {
  Frame frame;
  frame.origin = {static_cast<int32_t>(random() % 2000000) - 1000000,
                  static_cast<int32_t>(random() % 2000000) - 1000000,
                  static_cast<int32_t>(random() % 2000000) - 1000000};
  const TexturePoint x = randomDirection(random);
  TexturePoint y = crossOf(x, randomDirection(random));
  while (lengthOf(y) < 0.1) y = crossOf(x, randomDirection(random));
  y = unit(y);
  const TexturePoint z = crossOf(x, y);
  for (size_t i = 0; i < 3; ++i) {
    frame.rows[i] = static_cast<float>(x[i]);
    frame.rows[3 + i] = static_cast<float>(y[i]);
    frame.rows[6 + i] = static_cast<float>(z[i]);
  }
  return frame;
}

TexturePoint toWorld(const Frame& frame, const TexturePoint& q) {
  TexturePoint p{double(frame.origin.x), double(frame.origin.y), double(frame.origin.z)};
  for (size_t row = 0; row < 3; ++row) {
    for (size_t i = 0; i < 3; ++i) p[i] += q[row] * double{frame.rows[3 * row + i]};
  }
  return p;
}
TexturePoint turnedToWorld(const Frame& frame, const TexturePoint& q) {
  Frame at_origin = frame;
  at_origin.origin = {};
  return toWorld(at_origin, q);
}

/// A point on a shape's surface, and the normal there, in world coordinates.
struct SurfacePoint {
  TexturePoint place, normal;
};

struct Sample {
  GrammarChunk chunk;
  std::function<SurfacePoint(std::mt19937&)> point;  ///< returns a random point away from edges
  double stretch = 1.03;  ///< maximum ratio between lengths in the texture and on the surface
};

Shape leaf(ShapeKind kind, const Frame& frame, std::initializer_list<double> sizes) {
  Shape shape;
  shape.kind = kind;
  shape.frame = frame;
  size_t i = 0;
  for (const double size : sizes) shape.size[i++] = static_cast<float>(size);
  return shape;
}

std::vector<Sample> samplesOf(std::mt19937& random) {
  std::vector<Sample> samples;
  const auto add = [&](const Shape& shape, double stretch, auto local) {
    Sample& sample = samples.emplace_back();
    sample.chunk.shapes.push_back(shape);
    sample.stretch = stretch;
    sample.point = [frame = shape.frame, local](std::mt19937& r) {
      const auto [q, n] = local(r);
      return SurfacePoint{toWorld(frame, q), turnedToWorld(frame, n)};
    };
  };
  const double r = uniform(random, 3000, 9000);
  // The sphere is mapped like a cube, with equal angles on each face: at the cube's corners, tiles are some 30 %
  // smaller.
  add(leaf(ShapeKind::sphere, randomFrame(random), {r}), 1.45, [r](std::mt19937& g) {
    const TexturePoint d = randomDirection(g);
    return SurfacePoint{times(r, d), d};
  });
  const double x = uniform(random, 2000, 9000), y = uniform(random, 2000, 9000), z = uniform(random, 2000, 9000);
  add(leaf(ShapeKind::box, randomFrame(random), {x, y, z}), 1.001, [=](std::mt19937& g) {
    const std::array<double, 3> half{x, y, z};
    const size_t axis = g() % 3;
    const double side = g() % 2 == 0 ? 1 : -1;
    SurfacePoint s{{uniform(g, -x, x), uniform(g, -y, y), uniform(g, -z, z)}, {0, 0, 0}};
    s.place[axis] = side * half[axis];
    s.normal[axis] = side;
    return s;
  });
  const double bottom = uniform(random, 2000, 5000), top = uniform(random, 1900, 2000);
  // The number of tiles around the cone follows from its mean radius.
  add(leaf(ShapeKind::truncone, randomFrame(random), {bottom, top, y}), 1.6, [=](std::mt19937& g) {
    const double turn = uniform(g, 0, 2 * kPi), t = uniform(g, 0.02, 0.98);
    const double radius = bottom + t * (top - bottom), slope = (bottom - top) / (2 * y);
    return SurfacePoint{{radius * std::sin(turn), -y + 2 * y * t, radius * std::cos(turn)},
                        unit({std::sin(turn), slope, std::cos(turn)})};
  });
  add(leaf(ShapeKind::cylinder, randomFrame(random), {r, y}), 1.05, [=](std::mt19937& g) {
    if (g() % 2 == 0) {
      const double side = g() % 2 == 0 ? 1 : -1;
      return SurfacePoint{{uniform(g, -r / 2, r / 2), side * y, uniform(g, -r / 2, r / 2)}, {0, side, 0}};
    }
    const double turn = uniform(g, 0, 2 * kPi);
    return SurfacePoint{{r * std::sin(turn), uniform(g, -0.98 * y, 0.98 * y), r * std::cos(turn)},
                        {std::sin(turn), 0, std::cos(turn)}};
  });
  Shape capsule = leaf(ShapeKind::capsule, {}, {r});
  capsule.frame.origin = {12345, -777777, 31};
  const TexturePoint axis = times(40000, randomDirection(random));
  for (size_t i = 0; i < 3; ++i) capsule.size[i + 1] = static_cast<float>(std::floor(axis[i]));
  const TexturePoint line{double{capsule.size[1]}, double{capsule.size[2]}, double{capsule.size[3]}};
  samples.emplace_back().chunk.shapes.push_back(capsule);
  samples.back().stretch = 1.05;
  samples.back().point = [=](std::mt19937& g) {
    TexturePoint out = crossOf(line, randomDirection(g));
    while (lengthOf(out) < 1000) out = crossOf(line, randomDirection(g));
    const TexturePoint n = unit(out);
    return SurfacePoint{TexturePoint{12345, -777777, 31} + times(uniform(g, 0.1, 0.9), line) + times(r, n), n};
  };
  add(leaf(ShapeKind::halfspace, randomFrame(random), {}), 1.001, [](std::mt19937& g) {
    return SurfacePoint{{uniform(g, -1e5, 1e5), 0, uniform(g, -1e5, 1e5)}, {0, 1, 0}};
  });
  Shape prism = leaf(ShapeKind::prism, randomFrame(random), {y});
  const std::vector<Int3> corners{{-3000, 0, -2000}, {-2500, 0, 2500}, {0, 0, 4000}, {3500, 0, 1000}, {2000, 0, -3000}};
  prism.point_count = static_cast<uint32_t>(corners.size());
  add(prism, 1.001, [=](std::mt19937& g) {
    const size_t edge = g() % corners.size();
    const Int3 a = corners[edge], b = corners[(edge + 1) % corners.size()];
    const double t = uniform(g, 0.1, 0.9);
    const TexturePoint n = unit({-double(b.z - a.z), 0, double(b.x - a.x)});
    return SurfacePoint{{a.x + t * (b.x - a.x), uniform(g, -y, y), a.z + t * (b.z - a.z)}, n};
  });
  samples.back().chunk.points.assign(corners.begin(), corners.end());
  const double ring = uniform(random, 7000, 9000), tube = uniform(random, 1000, 2000);
  // The number of tiles around the torus is the same on the inner and the outer side.
  add(leaf(ShapeKind::torus, randomFrame(random), {ring, tube}), 1.45, [=](std::mt19937& g) {
    const double turn = uniform(g, 0, 2 * kPi), around = uniform(g, 0, 2 * kPi);
    const TexturePoint n{std::sin(turn) * std::cos(around), std::sin(around), std::cos(turn) * std::cos(around)};
    return SurfacePoint{TexturePoint{ring * std::sin(turn), 0, ring * std::cos(turn)} + times(tube, n), n};
  });
  // A beam of a single piece: its line runs along local z, and the beam extends beyond each end of the line by its
  // radius.
  const double length = uniform(random, 15000, 40000);
  const Frame frame = randomFrame(random);
  add(leaf(ShapeKind::box, frame, {r, r, length / 2 + r}), 1.06, [=](std::mt19937& g) {
    const double side = g() % 2 == 0 ? 1 : -1;
    if (g() % 3 == 0) {
      return SurfacePoint{{uniform(g, -r, r), uniform(g, -r, r), side * (length / 2 + r)}, {0, 0, side}};
    }
    const size_t across = g() % 2;
    SurfacePoint s{{0, 0, uniform(g, -length / 2, length / 2)}, {0, 0, 0}};
    s.place[across] = side * r;
    s.normal[across] = side;
    s.place[1 - across] = uniform(g, -0.97 * r, 0.97 * r);
    return s;
  });
  samples.back().chunk.shapes[0].point_count = 2;
  for (const double end : {-length / 2, length / 2}) {
    const TexturePoint p = toWorld(frame, {0, 0, end});
    samples.back().chunk.points.push_back(
        {static_cast<int32_t>(p[0]), static_cast<int32_t>(p[1]), static_cast<int32_t>(p[2])});
  }
  return samples;
}

}  // namespace

TEST_CASE("texture coordinates are as long as the surface, at right angles, and not mirrored on either side") {
  for (uint32_t seed = 1; seed <= rounds(20); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    size_t number = 0;
    for (const Sample& sample : samplesOf(random)) {
      CAPTURE(number++);
      const TextureSpace space(sample.chunk, 0, kUnitsPerMetre);
      for (int tries = 0; tries < 40; ++tries) {
        SurfacePoint s = sample.point(random);
        // Every second point is on a shape that is cut away, whose inside is void.
        if (tries % 2 == 1) s.normal = times(-1, s.normal);
        const Chart chart = space.chartOf(s.place, s.normal);
        TexturePoint side = crossOf(s.normal, randomDirection(random));
        while (lengthOf(side) < 0.1) side = crossOf(s.normal, randomDirection(random));
        const double step = 4;
        const TexturePoint a = times(step, unit(side)), b = crossOf(s.normal, a);
        const TextureCoordinates here = space.at(s.place, chart), period = space.period(chart);
        const auto way = [&](const TexturePoint& by) {
          TextureCoordinates to = space.at(s.place + by, chart);
          if (period.u > 0) to.u -= period.u * std::round((to.u - here.u) / period.u);
          if (period.v > 0) to.v -= period.v * std::round((to.v - here.v) / period.v);
          return TextureCoordinates{(to.u - here.u) * kUnitsPerMetre / step, (to.v - here.v) * kUnitsPerMetre / step};
        };
        const TextureCoordinates du = way(a), dv = way(b);
        // The vectors a, b and the normal are right-handed. So the directions of increasing u and of increasing v must
        // form a right-handed system with the normal, too.
        const double turn = du.u * dv.v - du.v * dv.u;
        CHECK(turn > 1 / (sample.stretch * sample.stretch));
        CHECK(turn < sample.stretch * sample.stretch);
        for (const TextureCoordinates& d : {du, dv}) {
          CHECK(std::hypot(d.u, d.v) < sample.stretch * 1.2);
          CHECK(std::hypot(d.u, d.v) > 1 / (sample.stretch * 1.2));
        }
      }
    }
  }
}

TEST_CASE("around what is closed a whole number of tiles fits, and both sides of the cut meet") {
  for (uint32_t seed = 1; seed <= rounds(20); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const double r = uniform(random, 60, 9000), half = uniform(random, 1000, 9000);
    GrammarChunk chunk;
    chunk.shapes.push_back(leaf(ShapeKind::cylinder, randomFrame(random), {r, half}));
    const TextureSpace space(chunk, 0, kUnitsPerMetre);
    const Frame& frame = chunk.shapes[0].frame;
    const Chart chart = space.chartOf(toWorld(frame, {0, 0, r}), turnedToWorld(frame, {0, 0, 1}));
    const double around = space.period(chart).u;
    CHECK(around == std::floor(around));
    CHECK(around >= 1);
    CHECK(std::fabs(around - 2 * kPi * r / kUnitsPerMetre) <= std::max(0.51, 1 - 2 * kPi * r / kUnitsPerMetre));
    const double angle = 1e-6;
    const double left = space.at(toWorld(frame, {-r * std::sin(angle), 0, -r * std::cos(angle)}), chart).u;
    const double right = space.at(toWorld(frame, {r * std::sin(angle), 0, -r * std::cos(angle)}), chart).u;
    CHECK(std::fabs(std::fabs(left - right) - around) < 0.01 * around);
  }
}

TEST_CASE("along a bent line the coordinates go on from segment to segment") {
  for (uint32_t seed = 1; seed <= rounds(20); ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    GrammarChunk chunk;
    Shape whole;
    whole.kind = ShapeKind::unite;
    whole.size[0] = 2000;
    // Makes a gently curved path, like the paths that sweeps usually follow.
    double heading = uniform(random, 0, 6);
    const double turn = uniform(random, -0.15, 0.15), climb = uniform(random, -0.3, 0.3);
    TexturePoint at{uniform(random, -1e6, 1e6), uniform(random, -1e6, 1e6), uniform(random, -1e6, 1e6)};
    for (int i = 0; i < 12; ++i) {
      chunk.points.push_back({int32_t(at[0]), int32_t(at[1]), int32_t(at[2])});
      at = at + TexturePoint{4000 * std::cos(heading), 4000 * climb, 4000 * std::sin(heading)};
      heading += turn;
    }
    whole.point_count = 12;
    chunk.shapes.push_back(whole);
    const TextureSpace space(chunk, 0, kUnitsPerMetre);
    const auto placeAt = [&](double along, double angle) {
      const auto i = static_cast<size_t>(along);
      const Int3 a = chunk.points[i], b = chunk.points[i + 1];
      const TexturePoint line{double(b.x - a.x), double(b.y - a.y), double(b.z - a.z)};
      const TexturePoint side = unit(crossOf(line, {0, 1, 0})), up = unit(crossOf(side, line));
      const TexturePoint on{a.x + (along - double(i)) * line[0], a.y + (along - double(i)) * line[1],
                            a.z + (along - double(i)) * line[2]};
      return on + times(2000 * std::cos(angle), up) + times(2000 * std::sin(angle), side);
    };
    const double angle = uniform(random, -2.5, 2.5);
    const Chart chart = space.chartOf(placeAt(0.5, angle), {1, 0, 0});
    TextureCoordinates before = space.at(placeAt(0.3, angle), chart);
    for (double along = 0.31; along < 10.6; along += 0.01) {
      const TextureCoordinates now = space.at(placeAt(along, angle), chart);
      CHECK(std::fabs(now.u - before.u) < 0.35);
      CHECK(std::fabs(now.v - before.v) < 0.7);
      before = now;
    }
    // The texture coordinate v grows by the length of the line.
    CHECK(before.v == Approx(10.6 * 4000 * std::hypot(1, climb) / kUnitsPerMetre).epsilon(0.02));
  }
}

TEST_CASE("a shape whose radii change with the place is left to the world's axes") {
  std::mt19937 random(7);
  GrammarChunk chunk;
  for (const ShapeKind kind : {ShapeKind::morph_power, ShapeKind::voxels, ShapeKind::morph}) {
    chunk.shapes = {leaf(kind, randomFrame(random), {2048, 2048, 2048})};
    CHECK(TextureSpace(chunk, 0, kUnitsPerMetre).byWorld());
  }
}
