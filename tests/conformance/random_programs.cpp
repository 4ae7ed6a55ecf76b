#include "random_programs.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

#include "field/builder.h"

namespace sgm {

namespace {

uint32_t randomLabel(std::mt19937& random) {
  const auto material = static_cast<uint16_t>(random() % 5), tag = static_cast<uint16_t>(random() % 4);
  return makeLabel(material, tag);
}

// Every random draw is a statement of its own, an initialiser in braces, or the only draw among a call's arguments: a
// seed must give the same program everywhere, and the order in which arguments are evaluated depends on the compiler.
class Generator {
 public:
  Generator(std::mt19937& random, Int3 centre, int32_t extent, int32_t finest_cell, bool solid, uint32_t domain,
            Oddities odd)
      : random_(random), centre_(centre), extent_(extent), odd_(odd), builder_(finest_cell, solid, domain) {}

  ProgramBuilder& builder() { return builder_; }

  int pick(int n) { return static_cast<int>(random_() % static_cast<uint32_t>(n)); }
  float between(double a, double b) {
    return static_cast<float>(a + (b - a) * static_cast<double>(random_()) / 4294967295.0);
  }
  uint32_t label() { return randomLabel(random_); }
  Int3 place(double spread = 1) {
    if (odd_.far_anchors && pick(5) == 0) return farPlace();
    auto axis = [&](int32_t c) {
      return saturate(int64_t{c} + static_cast<int64_t>(between(-spread, spread) * static_cast<float>(extent_)));
    };
    return {axis(centre_.x), axis(centre_.y), axis(centre_.z)};
  }
  // Returns a position near the limits of the coordinate range, on some axes or on all.
  Int3 farPlace() {
    auto axis = [&](int32_t c) {
      const int where = pick(6);
      const int32_t inwards = pick(2) ? pick(100'000'000) : 0;
      if (where == 0) return saturate(int64_t{c} + inwards);
      const bool low = where == 1 ? c < 0 : c >= 0;
      return low ? std::numeric_limits<int32_t>::min() + inwards : std::numeric_limits<int32_t>::max() - inwards;
    };
    return {axis(centre_.x), axis(centre_.y), axis(centre_.z)};
  }
  float size() { return between(0.05, 0.5) * static_cast<float>(extent_); }

  Frame frame(double spread = 1) {
    // f.rows becomes the matrix of a random unit quaternion, or sometimes stays the identity.
    Frame f;
    f.origin = place(spread);
    if (odd_.huge_and_tiny && pick(3) == 0) {
      // Set one entry to a tiny value, as a rotation by nearly zero does: its products are denormals.
      static constexpr float kNearlyNone[] = {1e-17f, -1e-20f, 1e-24f, 3e-39f};
      const int entry = 1 + 4 * pick(2) + pick(3);
      f.rows[static_cast<size_t>(entry)] = kNearlyNone[pick(4)];
      return f;
    }
    if (pick(3) == 0) return f;
    double q[4], s = 0;
    for (double& c : q) {
      c = double{between(-1, 1)};
      s += c * c;
    }
    s = std::sqrt(s) + 1e-9;
    for (double& c : q) c /= s;
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double rows[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                            2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                            2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
    for (size_t i = 0; i < 9; ++i) f.rows[i] = static_cast<float>(rows[i]);
    return f;
  }

  std::vector<Int3> polygon() {
    // Make a star-shaped (and so simple) polygon, counter-clockwise seen from +y: z decreases while the angle from +x
    // increases.
    const int n = 3 + pick(6);
    std::vector<Int3> corners;
    for (int i = 0; i < n; ++i) {
      const double a = 6.283185307179586 * i / n, r = double{size()};
      corners.push_back({static_cast<int32_t>(r * std::cos(a)), 0, static_cast<int32_t>(-r * std::sin(a))});
    }
    return corners;
  }

  NoiseSpec noiseSpec() {
    return {place(3), 1 + pick(pick(2) ? 20 : extent_), static_cast<uint32_t>(1 + pick(5)),
            static_cast<uint32_t>(random_())};
  }

  Value primitive(Op op, double spread = 1) {
    if (op == Op::kernel) {
      const Value distance = primitive(Op::sphere, spread);
      return builder_.kernelWeight(distance, size());
    }
    // These shapes have no frame.
    if (op == Op::sphere || op == Op::blob || op == Op::capsule) {
      const Int3 at = place(spread);
      const float a[4] = {size(), size(), size(), size()};
      const float none = op == Op::capsule && pick(6) == 0 ? 0.0f : 1.0f;
      const uint32_t l = label();
      if (op == Op::sphere) return builder_.sphere(at, a[0], l);
      if (op == Op::blob) return builder_.blobWeight(at, a[0], l);
      return builder_.capsule(at, a[1] * none, -a[2] * none, a[3] * none, a[0], l);
    }
    if (op == Op::lattice) return lattice(place(spread));
    const Frame f = frame(spread);
    const float a[6] = {size(), size(), size(), size(), size(), size()};
    const float exponent = between(2, 20);
    const float cone = pick(3) ? 1.0f : 0.0f;
    const uint32_t l = label();
    switch (op) {
      case Op::box:
        return builder_.box(f, a[0], a[1], a[2], l);
      case Op::cylinder:
        return builder_.cylinder(f, a[0], a[1], l);
      case Op::truncone:
        return builder_.truncone(f, a[0], a[1] * cone, a[2], l);
      case Op::torus:
        return builder_.torus(f, a[0] * 1.5f, a[1] * 0.5f, l);
      case Op::ellipsoid:
        return builder_.ellipsoid(f, a[0], a[1], a[2], l);
      case Op::superquadric:
        return builder_.superquadric(f, a[0], a[1], a[2], exponent, l);
      case Op::power_morph:
        return builder_.powerMorph(f, a, expression(2), l);
      case Op::prism:
        return builder_.prism(f, a[0], polygon(), l);
      default:
        return builder_.halfspace(f, l);
    }
  }

  // Makes a lattice of samples, all multiples of 1/1024. Some are huge: steeper than any distance field, or values that
  // mean "far".
  Value lattice(Int3 near) {
    SampleLattice at;
    at.spacing = 1 + pick(extent_ / 2);
    for (int axis = 0; axis < 3; ++axis) {
      const auto count = static_cast<uint32_t>(4 + pick(5));
      at.count[static_cast<size_t>(axis)] = count;
      const int64_t last = std::numeric_limits<int32_t>::max() - int64_t{count - 1} * at.spacing;
      at.origin[axis] = static_cast<int32_t>(std::min<int64_t>(near[axis], last));
    }
    std::vector<float> samples(*latticePoints(at));
    const double largest = odd_.huge_and_tiny && pick(3) == 0 ? 1e12 : extent_;
    for (float& sample : samples) sample = std::floor(between(-largest, largest) * 1024.0f) / 1024.0f;
    const float limit = pick(3) == 0 ? size() : kFarSample;
    // If the slope need not be bounded, sometimes put one value that means "far" next to normal values.
    const int sentinel = pick(static_cast<int>(samples.size()));
    if (limit == kFarSample && pick(2) == 0) samples[static_cast<size_t>(sentinel)] = kLargestSample;
    return builder_.lattice(at, samples, limit, label());
  }

  Value anyPrimitive() {
    static constexpr Op kAll[] = {Op::sphere,      Op::box,       Op::cylinder,  Op::truncone,
                                  Op::capsule,     Op::torus,     Op::ellipsoid, Op::superquadric,
                                  Op::power_morph, Op::halfspace, Op::prism,     Op::lattice};
    const Op op = kAll[pick(static_cast<int>(std::size(kAll)))];
    // Some operands lie far outside of the sampled points, where their values are large and positive. Wrong pruning
    // would choose these operands.
    return primitive(op, pick(5) == 0 ? 6.0 : 1.0);
  }

  // Makes nested squares, whose values (in metres) exceed 1e18, or are below 1e-30 if the factor is small, with
  // correspondingly extreme gradients.
  Value tower() {
    const Frame f = frame();
    Value v = builder_.coordinate(f.origin, f.rows[0], f.rows[1], f.rows[2]);
    const bool tiny = pick(2) == 0;
    if (tiny) {
      v = builder_.binary(Op::multiply, v, builder_.constant(between(-0.05, 0.05)));
    } else if (pick(2)) {
      v = builder_.binary(Op::add, v, builder_.constant(between(-2000, 2000)));
    }
    for (int n = 3 + pick(5); n > 0; --n) v = builder_.binary(Op::multiply, v, v);
    return v;
  }
  Value extreme() {
    static constexpr float kExtremes[] = {1e-38f, 3e-39f, 1e-42f, -1e-30f, 2e-20f, 1e17f, -1e19f, 3e38f};
    switch (pick(3)) {
      case 0:
        return builder_.constant(kExtremes[pick(static_cast<int>(std::size(kExtremes)))]);
      case 1: {
        const Value a = tower();
        return builder_.binary(Op::divide, a, tower());
      }
      default:
        return tower();
    }
  }

  Value expression(int depth) {
    if (odd_.huge_and_tiny && pick(4) == 0) return extreme();
    switch (pick(depth > 0 ? 14 : 4)) {
      case 0:
        return builder_.constant(between(-1, 1.5));
      case 1: {
        const Frame f = frame();
        return builder_.coordinate(f.origin, f.rows[0], f.rows[1], f.rows[2]);
      }
      case 2: {
        const NoiseSpec n = noiseSpec();
        return builder_.noise(n, static_cast<uint32_t>(pick(static_cast<int>(n.octaves) + 1)));
      }
      case 3: {
        const Int3 line[] = {place(), place(), place(), place()};
        return builder_.sweep(line);
      }
      case 4:
        return builder_.unary(Op::negate, expression(depth - 1));
      case 5:
        return builder_.unary(Op::absolute, expression(depth - 1));
      case 6:
        return builder_.unary(Op::floor, expression(depth - 1));
      case 7:
        return builder_.unary(Op::square_root, expression(depth - 1));
      case 8: {
        const Value x = expression(depth - 1);
        const float lower = between(-3, 0), width = between(0.5, 3);
        return builder_.smoothstep(x, lower, pick(2) ? width - 3.5f : -width - 3.5f);
      }
      case 9: {
        const Value a = expression(depth - 1), b = expression(depth - 1);
        return builder_.ternary(Op::mix, a, b, expression(depth - 1));
      }
      case 10: {
        const Value a = expression(depth - 1);
        return builder_.binary(Op::divide, a, expression(depth - 1));
      }
      default: {
        static constexpr Op kAll[] = {Op::add, Op::subtract, Op::multiply, Op::less, Op::minimum, Op::maximum};
        const Op op = kAll[pick(6)];
        const Value a = expression(depth - 1);
        return builder_.binary(op, a, expression(depth - 1));
      }
    }
  }

  Value shape(int depth) {
    if (depth <= 0) return anyPrimitive();
    switch (pick(10)) {
      case 0:
        return chain(Op::minimum, depth);
      case 1:
        return chain(Op::maximum, depth);
      case 2:
        return chain(Op::cut, depth);
      case 3:
        return round(depth);
      case 4:
        return builder_.unary(Op::negate, builder_.unary(Op::negate, round(depth)));
      case 5:
        return sum(depth);
      case 6: {
        const Value a = shape(depth - 1), b = shape(depth - 1);
        const Value t = pick(3) ? expression(2) : builder_.constant(between(-0.5, 1.5));
        return builder_.ternary(Op::morph, a, b, t);
      }
      case 7: {
        const Value a = shape(depth - 1);
        const NoiseSpec n = noiseSpec();
        const Value amplitude = builder_.constant(between(0, 0.1) * static_cast<float>(extent_) / 1024.0f);
        return builder_.binary(Op::displace, a, builder_.binary(Op::multiply, amplitude, builder_.noise(n, n.octaves)));
      }
      case 8: {
        const Value scale = builder_.constant(between(0, 0.1) * static_cast<float>(extent_) / 1024.0f);
        Value moved[3];
        for (Value& m : moved) m = builder_.binary(Op::multiply, scale, builder_.noise(noiseSpec(), 1));
        builder_.pushWarp(moved[0], moved[1], moved[2]);
        const Value inner = shape(depth - 1);
        builder_.popWarp();
        return inner;
      }
      default:
        return chain(Op::minimum, depth);
    }
  }

  Value chain(Op op, int depth) {
    Value v = shape(depth - 1);
    for (int n = 1 + pick(4); n > 0; --n) v = builder_.binary(op, v, shape(depth - 1));
    return v;
  }

  Value round(int depth) {
    RoundUnion acc(builder_, size() * 0.3f);
    for (int n = 1 + pick(6); n > 0; --n) acc.add(shape(depth - 1));
    return acc.end();
  }

  Value sum(int depth) {
    KernelSum acc(builder_);
    for (int n = 1 + pick(8); n > 0; --n) {
      if (pick(3) != 0) {
        acc.add(primitive(Op::blob));
      } else {
        const Value distance = shape(depth - 1);
        acc.add(builder_.kernelWeight(distance, size()));
      }
    }
    return acc.end(0.2263f, size());
  }

  IntBox influence() {
    const Int3 c = place(0.5);
    const auto r = static_cast<int32_t>(between(0.3, 2) * static_cast<float>(extent_));
    return IntBox{c, c}.grown(r);
  }

 private:
  std::mt19937& random_;
  Int3 centre_;
  int32_t extent_;
  Oddities odd_;
  ProgramBuilder builder_;
};

}  // namespace

FieldProgram randomProgram(std::mt19937& random, const RandomProgramOptions& o) {
  const bool solid = random() % 2 == 0;
  const uint32_t domain = randomLabel(random);
  Generator g(random, o.centre, o.extent, o.finest_cell, solid, domain, o.odd);
  const int layers = 1 + g.pick(3);
  for (int layer = 0; layer < layers; ++layer) {
    const int adds = g.pick(o.groups + 1);
    for (int i = 0; i < o.groups; ++i) {
      const Value root = g.shape(g.pick(o.depth + 1));
      const IntBox influence = o.whole_influence ? IntBox::everything() : g.influence();
      // The builder rejects a group that needs too many registers; another test checks that error, so ignore it here.
      (void)g.builder().group(root, influence, static_cast<uint32_t>(layer), i >= adds);
    }
  }
  for (int i = 0; i < o.smooth_groups; ++i) {
    const Value root = g.shape(g.pick(2));
    const IntBox influence = o.whole_influence ? IntBox::everything() : g.influence();
    const float width = g.pick(4) == 0 ? 1.0f : g.size();
    const bool cut = g.pick(2) == 0;
    (void)g.builder().group(root, influence, static_cast<uint32_t>(layers + i), cut, width);
  }
  return g.builder().finish();
}

FieldProgram programOf(Op op, std::mt19937& random, Int3 centre, Oddities odd) {
  // The domain is void. The field is the minimum of the domain and the op, so a solid domain would hide the op's value.
  const uint32_t domain = randomLabel(random);
  Generator g(random, centre, 16 * 1024, 512, false, domain, odd);
  ProgramBuilder& b = g.builder();
  auto expression = [&] { return g.expression(1); };
  Value v;
  switch (op) {
    case Op::constant:
      v = b.constant(g.between(-100, 100));
      break;
    case Op::coordinate: {
      const Int3 anchor = g.place();
      const float row[3] = {g.between(-1, 1), g.between(-1, 1), g.between(-1, 1)};
      v = b.coordinate(anchor, row[0], row[1], row[2]);
      break;
    }
    case Op::noise: {
      const NoiseSpec n = g.noiseSpec();
      v = b.noise(n, n.octaves);
      break;
    }
    case Op::sweep: {
      const Int3 line[] = {g.place(), g.place(), g.place()};
      v = b.sweep(line);
      break;
    }
    case Op::copy:
      v = b.unary(Op::copy, expression());
      break;
    case Op::negate:
    case Op::absolute:
    case Op::floor:
    case Op::square_root:
      v = b.unary(op, expression());
      break;
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::less: {
      const Value a = expression();
      v = b.binary(op, a, expression());
      break;
    }
    case Op::smoothstep:
      v = b.smoothstep(expression(), -0.5f, 0.75f);
      break;
    case Op::mix: {
      const Value a = expression(), c = expression();
      v = b.ternary(op, a, c, expression());
      break;
    }
    case Op::minimum:
    case Op::maximum:
    case Op::cut: {
      const Value a = g.anyPrimitive();
      v = b.binary(op, a, g.anyPrimitive());
      break;
    }
    case Op::morph: {
      const Value a = g.anyPrimitive(), c = g.anyPrimitive();
      v = b.ternary(op, a, c, expression());
      break;
    }
    case Op::displace: {
      const Value a = g.anyPrimitive();
      v = b.binary(op, a, expression());
      break;
    }
    case Op::round_begin:
    case Op::round_add:
    case Op::round_end:
      v = g.round(1);
      break;
    case Op::sum_begin:
    case Op::sum_add:
    case Op::sum_end:
      v = g.sum(1);
      break;
    case Op::warp: {
      const Value x = expression(), y = expression();
      b.pushWarp(x, y, expression());
      v = g.anyPrimitive();
      b.popWarp();
      break;
    }
    default:
      v = g.primitive(op);
      break;
  }
  (void)b.group(v, IntBox::everything(), 0, false);
  return b.finish();
}

}  // namespace sgm
