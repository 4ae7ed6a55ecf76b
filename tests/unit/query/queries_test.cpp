// Tests rays and nearest points of the field against analytic answers and dense sampling, far from the origin as well
// as near it.

#include <algorithm>
#include <cmath>
#include <random>

#include "asked_world.h"
#include "backend/cpu/instruction_sets.h"
#include "rounds.h"

using namespace sgm;

namespace {

using Vector = std::array<double, 3>;

double length(const Vector& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }
Vector less(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector along(const Vector& from, const Vector& direction, double t) {
  return {from[0] + t * direction[0], from[1] + t * direction[1], from[2] + t * direction[2]};
}
double product(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector unit(const Vector& v) {
  const double size = length(v);
  return {v[0] / size, v[1] / size, v[2] / size};
}

class Dice {
 public:
  explicit Dice(uint32_t seed) : random_(seed) {}
  double real(double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random_); }
  Vector place(double within) { return {real(-within, within), real(-within, within), real(-within, within)}; }
  Vector direction() {
    while (true) {
      const Vector v = place(1);
      const double size = length(v);
      if (size > 0.1 && size < 1) return unit(v);
    }
  }

 private:
  std::mt19937 random_;
};

std::optional<SurfacePoint> cast(const QueryField& field, const Vector& from, const Vector& direction, double far) {
  const auto hit = rayCast(field, from, direction, far);
  INFO((hit ? "" : hit.error().message));
  REQUIRE(hit);
  return *hit;
}

std::optional<SurfacePoint> closest(const QueryField& field, const Vector& place, double far) {
  const auto found = closestPoint(field, place, far);
  INFO((found ? "" : found.error().message));
  REQUIRE(found);
  return *found;
}

bool solidAt(const QueryField& field, Int3 p) {
  const auto program = field.at({p, p});
  REQUIRE(program);
  EvalScratch scratch;
  int32_t q = 0;
  bestKernels().samples((*program)->view(), {&p.x, &p.y, &p.z, 1}, scratch, &q);
  return q < 0;
}

Int3 rounded(const Vector& p) {
  const auto whole = [](double v) { return static_cast<int32_t>(std::floor(v + 0.5)); };
  return {whole(p[0]), whole(p[1]), whole(p[2])};
}

/// Signed distance to a box around the origin with edges `size`, rotated around y by an angle.
double boxDistance(Vector p, const Vector& size, double angle) {
  p = {std::cos(angle) * p[0] - std::sin(angle) * p[2], p[1], std::sin(angle) * p[0] + std::cos(angle) * p[2]};
  Vector outside{};
  double inside = -1e9;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double d = std::fabs(p[axis]) - size[axis] / 2;
    outside[axis] = std::max(d, 0.0);
    inside = std::max(inside, d);
  }
  return length(outside) + std::min(inside, 0.0);
}

}  // namespace

TEST_CASE("rays hit a ball where they should, with its normal, and miss it where they should") {
  const Asked asked(oneShape("sphere(5m); mat marble; tag \"toy.ball\";"));
  const double radius = 5 * kMetre;
  Dice dice(11);
  int hits = 0, misses = 0;
  for (unsigned i = 0; i < rounds(400); ++i) {
    CAPTURE(i);
    const Vector from = dice.place(9 * kMetre), direction = dice.direction();
    const double b = product(from, direction), c = product(from, from) - radius * radius, root = b * b - c;
    const auto hit = cast(asked.field, from, direction, 30 * kMetre);
    if (c < -20 * kMetre) {
      REQUIRE(hit);
      CHECK(hit->inside);
      CHECK(hit->distance == 0);
      CHECK(hit->position == from);
    } else if (c > 20 * kMetre && (root < -1e5 || b > 0)) {
      CHECK_FALSE(hit);
      ++misses;
    } else if (c > 20 * kMetre && root > 1e5) {
      REQUIRE(hit);
      ++hits;
      CHECK_FALSE(hit->inside);
      CHECK(hit->distance == Approx(-b - std::sqrt(root)).margin(2 * radius / std::sqrt(root)));
      CHECK(length(less(hit->position, along(from, direction, hit->distance))) < 1e-6);
      CHECK(length(hit->position) - radius > -0.9);
      CHECK(length(less(hit->normal,
                        {hit->position[0] / radius, hit->position[1] / radius, hit->position[2] / radius})) < 2e-3);
      CHECK(hit->material == 1);
      CHECK(hit->tag == 1);
      // A ray that is just too short finds nothing.
      CHECK_FALSE(cast(asked.field, from, direction, hit->distance - 4));
      CHECK(cast(asked.field, from, along({}, direction, 1e-200), hit->distance + 4));
    }
  }
  CHECK(hits > 5);
  CHECK(misses > 20);
}

TEST_CASE("rays and nearest points agree with a turned box, near the origin and 1,500 km from it") {
  const Vector size{4 * kMetre, 2 * kMetre, 7 * kMetre};
  const double angle = 30 * 3.14159265358979 / 180;
  const std::string shape = "rot(y, 30deg) box(4m, 2m, 7m);";
  constexpr int32_t kMoved = 1'500'000 * 1024;
  const Int3 far{kMoved, -kMoved, kMoved};
  const Asked near_world(oneShape(shape)), far_world(oneShape(shape, 256, far));
  const Vector shift{kMoved, -kMoved, kMoved};
  // Determines from a sample of the shape in which direction the language's rotation turns.
  const double turned =
      solidAt(near_world.field, rounded({std::sin(angle) * 3 * kMetre, 0, std::cos(angle) * 3 * kMetre})) ? angle
                                                                                                          : -angle;
  Dice dice(5);
  int hits = 0, nearest = 0;
  for (unsigned i = 0; i < rounds(200); ++i) {
    CAPTURE(i);
    // The coordinates are multiples of 1/16 unit, so that they are exact near the origin and far from it.
    Vector from = dice.place(6 * kMetre);
    for (double& p : from) p = std::floor(p * 16) / 16;
    const Vector there = along(shift, from, 1);
    const Vector direction = i % 2 == 0 ? dice.direction() : unit(less(dice.place(1.5 * kMetre), from));
    const double away = boxDistance(from, size, turned);
    const auto hit = cast(near_world.field, from, direction, 20 * kMetre);
    const auto far_hit = cast(far_world.field, there, direction, 20 * kMetre);
    REQUIRE(hit.has_value() == far_hit.has_value());
    if (hit) {
      hits += !hit->inside;
      CHECK(length(less(less(far_hit->position, hit->position), shift)) < 1e-5);
      CHECK(far_hit->distance == hit->distance);
      CHECK(far_hit->normal == hit->normal);
      if (!hit->inside) CHECK(std::fabs(boxDistance(hit->position, size, turned)) < 1.5);
      // The ray passes no solid before the hit.
      for (double t = 0; t < hit->distance - 1; t += 40) {
        CHECK(boxDistance(along(from, direction, t), size, turned) > -1.5);
      }
    } else {
      for (double t = 0; t < 20 * kMetre; t += 10) {
        CHECK(boxDistance(along(from, direction, t), size, turned) > -16);
      }
    }

    const auto found = closest(near_world.field, from, 8 * kMetre);
    const auto far_found = closest(far_world.field, there, 8 * kMetre);
    REQUIRE(found.has_value() == (std::fabs(away) < 8 * kMetre));
    REQUIRE(far_found.has_value() == found.has_value());
    if (!found) continue;
    ++nearest;
    CHECK(found->inside == (away < 0));
    CHECK(std::fabs(boxDistance(found->position, size, turned)) < 1.5);
    CHECK(length(less(found->position, from)) == Approx(found->distance).margin(1e-6));
    // The interface documents the tolerance: a distance may be too large by a quarter of a cell (64 units) plus 1/64 of
    // the distance. The test allows 1.5 units more, and 1.5 units less.
    CHECK(found->distance > std::fabs(away) - 1.5);
    CHECK(found->distance < std::fabs(away) * 65 / 64 + 64 + 1.5);
    CHECK(far_found->distance == found->distance);
    CHECK(far_found->normal == found->normal);
    CHECK(length(less(less(far_found->position, found->position), shift)) < 1e-5);
  }
  CHECK(hits > 3);
  CHECK(nearest > 20);
}

TEST_CASE("the surface nearest to a place by a ball is exact, inside and out") {
  const Asked asked(oneShape("sphere(5m);"));
  const double radius = 5 * kMetre;
  Dice dice(3);
  double worst = 0;
  for (unsigned i = 0; i < rounds(150); ++i) {
    CAPTURE(i);
    const Vector from = dice.place(8 * kMetre);
    const double away = std::fabs(length(from) - radius);
    const auto found = closest(asked.field, from, 20 * kMetre);
    REQUIRE(found);
    CHECK(found->distance > away - 1.5);
    CHECK(found->distance < away * 65 / 64 + 64 + 1.5);
    worst = std::max(worst, found->distance - away);
    CHECK(found->inside == (length(from) < radius - 1 || (length(from) < radius + 1 && found->inside)));
    // If the search radius is smaller than the distance to the surface, nothing is found.
    if (away > 8) CHECK_FALSE(closest(asked.field, from, away - 4 - away / 64));
  }
  WARN("nearest points: at most " << worst << " units too far");
  // All points of the surface have the same distance from the middle.
  const auto middle = closest(asked.field, {0, 0, 0}, 20 * kMetre);
  REQUIRE(middle);
  CHECK(middle->distance == Approx(radius).margin(64 + radius / 64));
  CHECK(middle->inside);
}

TEST_CASE("the answers do not depend on the cell, odd, tiny or larger than the shape") {
  for (const int32_t cell : {1, 3, 77, 250, 1000, 3001}) {
    CAPTURE(cell);
    const Asked asked(oneShape("at(0.4m, 0.3m, -0.2m) sphere(1m);", cell));
    const Vector middle{0.4 * kMetre, 0.3 * kMetre, -0.2 * kMetre};
    Dice dice(static_cast<uint32_t>(cell));
    for (int i = 0; i < 12; ++i) {
      const Vector from = along(middle, dice.direction(), dice.real(1.02, 1.04) * kMetre);
      const double away = length(less(from, middle)) - kMetre;
      const Vector towards = less(middle, from);
      const auto hit = cast(asked.field, from, towards, 4 * kMetre);
      // The larger the cells, the larger the tolerance. If a cell is three times as large as the ball's radius, the
      // ball may lie between samples, and the quantised field is as coarse as the cell.
      const double rough = 2 + cell / 512.0;
      REQUIRE(hit);
      CHECK(hit->distance == Approx(away).margin(rough));
      const auto found = closest(asked.field, from, 60);
      if (cell <= 250) REQUIRE(found);
      if (found) CHECK(found->distance == Approx(away).margin(rough));
    }
  }
}

TEST_CASE("a wall is hit from any side, a cell thick or a sixteenth of one") {
  for (const auto& [thick, cell] : {std::pair{0.25, 256}, std::pair{1.0, 1024}, std::pair{0.0166, 256}}) {
    const Asked asked(
        oneShape("at(0.137m, 0.211m, 0m) rot(x, 33deg) box(30m, " + std::to_string(thick) + "m, 30m);", cell));
    Dice dice(7);
    int crossed = 0;
    for (unsigned i = 0; i < rounds(200); ++i) {
      CAPTURE(thick, cell, i);
      const Vector from = dice.place(3 * kMetre), direction = dice.direction();
      // side() is the signed distance from the wall's middle plane. `turn` is the direction of the wall's rotation,
      // which is determined from a sample.
      const double c = std::cos(33 * 3.14159265358979 / 180), s = std::sin(33 * 3.14159265358979 / 180);
      const auto side = [&](const Vector& p, double turn) { return c * (p[1] - 0.211 * kMetre) + turn * s * p[2]; };
      const Vector to = along(from, direction, 8 * kMetre);
      for (const double turn : {1.0, -1.0}) {
        const bool this_way =
            solidAt(asked.field, rounded({0.137 * kMetre, 0.211 * kMetre - turn * s * 5 * kMetre, c * 5 * kMetre}));
        if (!this_way || side(from, turn) * side(to, turn) >= 0) continue;
        CHECK(cast(asked.field, from, direction, 8 * kMetre));
        ++crossed;
      }
    }
    CHECK(crossed > 5);
  }
}

TEST_CASE("random rays and places in the cave agree with dense sampling, here and 1,500 km away") {
  const WorldFieldSettings settings = settingsOf(caveText(), 256);
  WorldFieldSettings moved = settings;
  constexpr int32_t kMoved = 1 << 30;
  moved.shift = {kMoved + (1 << 28) + (1 << 27), -kMoved, 1 << 28};
  const Asked asked(settings), far_asked(moved);
  const Vector shift{static_cast<double>(moved.shift.x), static_cast<double>(moved.shift.y),
                     static_cast<double>(moved.shift.z)};
  const auto anchors = asked.world.anchors({{0, 0, 0}, {192 * 1024, 192 * 1024, 192 * 1024}});
  REQUIRE(anchors);
  const Int3 spawn = anchors->front().frame.origin;
  int hits = 0, inside = 0;
  for (uint32_t seed = 1; seed <= rounds(30); ++seed) {
    CAPTURE(seed);
    Dice dice(seed);
    const Vector off = dice.place(7 * kMetre);
    const Vector from{std::floor(spawn.x + off[0]), std::floor(spawn.y + off[1]) + 0.25, std::floor(spawn.z + off[2])};
    const Vector direction = dice.direction();
    const double far = dice.real(1, 40) * kMetre;
    const auto hit = cast(asked.field, from, direction, far);

    // Marches along the ray in steps of 16 units, for comparison.
    IntBox box = IntBox{rounded(from), rounded(from)}
                     .joined({rounded(along(from, direction, far)), rounded(along(from, direction, far))})
                     .grown(1);
    const auto program = asked.field.at(box);
    REQUIRE(program);
    EvalScratch scratch;
    std::optional<double> first;
    for (int step = 0; step * 16 < far && !first; ++step) {
      const Int3 p = rounded(along(from, direction, step * 16));
      int32_t q = 0;
      bestKernels().samples((*program)->view(), {&p.x, &p.y, &p.z, 1}, scratch, &q);
      if (q < 0) first = step * 16;
    }
    if (first) {
      REQUIRE(hit);
      hits += *first > 0;
      inside += *first == 0;
      CHECK(hit->inside == (*first == 0));
      CHECK(hit->distance <= *first);
      CHECK(hit->distance >= std::max(0.0, *first - 16));
      CHECK(hit->material < settings.program->materials.size());
    } else if (hit) {
      CHECK(hit->distance > far - 16);
    }
    const auto far_hit = cast(far_asked.field, along(shift, from, 1), direction, far);
    REQUIRE(far_hit.has_value() == hit.has_value());
    if (hit) CHECK(far_hit->distance == hit->distance);

    const double reach = 3 * kMetre;
    const auto found = closest(asked.field, from, reach);
    const auto far_found = closest(far_asked.field, along(shift, from, 1), reach);
    REQUIRE(far_found.has_value() == found.has_value());
    if (found) CHECK(far_found->distance == found->distance);
    const bool here = solidAt(asked.field, rounded(from));
    const auto around = asked.field.at(IntBox{rounded(from), rounded(from)}.grown(4096));
    REQUIRE(around);
    double nearest = 1e9;
    std::vector<int32_t> x, y, z;
    for (int n = 0; n < 49 * 49 * 49; ++n) {
      x.push_back(rounded(from).x + (n % 49 - 24) * 128);
      y.push_back(rounded(from).y + (n / 49 % 49 - 24) * 128);
      z.push_back(rounded(from).z + (n / 49 / 49 - 24) * 128);
    }
    std::vector<int32_t> q(x.size());
    bestKernels().samples((*around)->view(), {x.data(), y.data(), z.data(), x.size()}, scratch, q.data());
    for (size_t i = 0; i < q.size(); ++i) {
      if ((q[i] < 0) == here) continue;
      const Vector p{static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
      nearest = std::min(nearest, length(less(p, from)));
    }
    // Parts that lie between the samples of level 0 may be missed; the cave has hardly any such parts.
    if (nearest < reach - 128) {
      REQUIRE(found);
      CHECK(found->distance < nearest * 65 / 64 + 64);
    }
    if (found) {
      CHECK(found->inside == here);
      CHECK(solidAt(asked.field, rounded(found->position)) == here);
      CHECK(length(less(found->position, from)) == Approx(found->distance).margin(1e-6));
      CHECK(found->distance > nearest - 128 * 1.75);
    }
  }
  CHECK(hits > 1);
  CHECK(hits + inside > 2);
}

TEST_CASE("queries refuse what is not finite, outside of the world, or too much") {
  const Asked asked(oneShape("sphere(5m);"));
  const QueryField& field = asked.field;
  const double nan = std::nan(""), infinite = HUGE_VAL;
  const Vector up{0, 1, 0};
  const auto codeOf = [](const auto& result) {
    REQUIRE_FALSE(result);
    CHECK_FALSE(result.error().message.empty());
    return result.error().code;
  };
  for (const double bad : {nan, infinite, -infinite}) {
    CHECK(codeOf(rayCast(field, {bad, 0, 0}, up, 1)) == Code::invalid_argument);
    CHECK(codeOf(rayCast(field, {0, 0, 0}, {0, bad, 0}, 1)) == Code::invalid_argument);
    CHECK(codeOf(closestPoint(field, {0, 0, bad}, 1)) == Code::invalid_argument);
  }
  CHECK(codeOf(rayCast(field, {0, 0, 0}, {0, 0, 0}, 1)) == Code::invalid_argument);
  for (const double bad : {nan, -1.0}) {
    CHECK(codeOf(rayCast(field, {0, 0, 0}, up, bad)) == Code::invalid_argument);
    CHECK(codeOf(closestPoint(field, {0, 0, 0}, bad)) == Code::invalid_argument);
  }
  CHECK(codeOf(rayCast(field, {0, 0, 0}, up, infinite)) == Code::limit);
  CHECK(codeOf(rayCast(field, {0, 0, 0}, up, static_cast<double>(longestRay(256)) + 1)) == Code::limit);
  CHECK(codeOf(closestPoint(field, {0, 0, 0}, static_cast<double>(farthestSurface(256)) + 1)) == Code::limit);
  for (const double bad : {-2147483649.0, 2147483648.0, 1e300}) {
    CHECK(codeOf(rayCast(field, {0, bad, 0}, up, 1)) == Code::range);
    CHECK(codeOf(closestPoint(field, {bad, 0, 0}, 1)) == Code::range);
  }
  const IntBox box{{0, 0, 0}, {1024, 1024, 1024}};
  CHECK(codeOf(isWalkable(field, IntBox{}, {})) == Code::invalid_argument);
  CHECK(codeOf(isWalkable(field, IntBox::everything(), {})) == Code::range);
  CHECK(codeOf(isWalkable(field, {{0, 0, 0}, {1 << 20, 1 << 20, 1 << 20}}, {})) == Code::limit);
  for (const double bad : {nan, -1.0, infinite}) {
    for (double Walker::*member : {&Walker::radius, &Walker::height, &Walker::step, &Walker::slope}) {
      Walker walker;
      walker.*member = bad;
      CHECK(codeOf(isWalkable(field, box, walker)) == Code::invalid_argument);
    }
  }
  Walker walker;
  walker.area = nan;
  CHECK(codeOf(isWalkable(field, box, walker)) == Code::invalid_argument);

  // If the field fails, the query returns the field's error.
  const QueryField broken{[](const IntBox&) -> Result<std::shared_ptr<const FieldProgram>> {
                            return Error{Code::cancelled, "not now"};
                          },
                          256};
  CHECK(codeOf(rayCast(broken, {0, 0, 0}, up, 1)) == Code::cancelled);
  CHECK(codeOf(closestPoint(broken, {0, 0, 0}, 1)) == Code::cancelled);
  CHECK(codeOf(isWalkable(broken, box, {})) == Code::cancelled);
}

TEST_CASE("rays and searches end where the world does") {
  const Asked asked(oneShape("sphere(5m);"));
  const double end = 2147483647.0, begin = -2147483648.0;
  for (const Vector& from : {Vector{end, end, end}, Vector{begin, begin, begin}, Vector{begin, 0, end}}) {
    for (const Vector& direction : {Vector{1, 1, 1}, Vector{-1, -1, -1}, Vector{1, -1, 0.5}, Vector{0, 0, 1}}) {
      CHECK_FALSE(cast(asked.field, from, direction, 4000 * kMetre));
    }
    CHECK_FALSE(closest(asked.field, from, 60 * kMetre));
  }
}
