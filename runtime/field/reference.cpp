#include "field/reference.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.h"
#include "field/lattice.h"

namespace sgm {

namespace {

struct Local {
  double x, y, z;
};

// The C library's hypot and pow are not used, because their last bits differ between libraries, and derived shapes
// depend on these values.
double hypotenuse(double x, double y, double z = 0) { return std::sqrt(x * x + y * y + z * z); }

// Returns an offset along an axis, clamped to the range of an int32, where the evaluators saturate (real.h).
double minus(double v, double centre) { return std::clamp(v - centre, -2147483648.0, 2147483647.0); }

// Returns a position relative to a centre. p: the parameter words of the centre.
Local offsetFrom(const uint32_t* p, double x, double y, double z) {
  return {minus(x, wholeAt(p, 0)), minus(y, wholeAt(p, 1)), minus(z, wholeAt(p, 2))};
}
Local offset(const uint32_t* p, double x, double y, double z) { return offsetFrom(p + 1, x, y, z); }

Local toLocal(const uint32_t* p, double x, double y, double z) {
  const Local d = offset(p, x, y, z);
  auto row = [&](int i) { return realAt(p, i) * d.x + realAt(p, i + 1) * d.y + realAt(p, i + 2) * d.z; };
  return {row(4), row(7), row(10)};
}

// Returns the signed distance to the planar region {a <= 0 and b <= 0}. a, b: signed distances from two perpendicular
// sides of the region.
double corner(double a, double b) {
  return hypotenuse(std::max(a, 0.0), std::max(b, 0.0)) + std::min(std::max(a, b), 0.0);
}

double trunconeDistance(double radial, double y, double bottom, double top, double h) {
  // The distance to the trapezoid (0,-h) (bottom,-h) (top,h) (0,h), mirrored at the axis, is the distance to the
  // nearest of its three outer edges.
  const std::array<std::array<double, 2>, 4> corners{{{0, -h}, {bottom, -h}, {top, h}, {0, h}}};
  double best = 1e300;
  for (size_t i = 0; i < 3; ++i) {
    const double ex = corners[i + 1][0] - corners[i][0], ey = corners[i + 1][1] - corners[i][1];
    const double wx = radial - corners[i][0], wy = y - corners[i][1];
    const double length2 = ex * ex + ey * ey;
    const double t = length2 > 0 ? std::clamp((wx * ex + wy * ey) / length2, 0.0, 1.0) : 0.0;
    best = std::min(best, hypotenuse(wx - t * ex, wy - t * ey));
  }
  const double width = bottom + (top - bottom) * (y + h) / (2 * h);
  const bool inside = std::abs(y) <= h && radial <= width;
  return inside ? -best : best;
}

double prismDistance(const uint32_t* p, const Local& q) {
  const int count = static_cast<int>(p[14]);
  double best = 1e300;
  bool inside = false;
  for (int k = 0; k < count; ++k) {
    const int at = 15 + 6 * k;
    const double ax = realAt(p, at), az = realAt(p, at + 1), ex = realAt(p, at + 2), ez = realAt(p, at + 3);
    const double wx = q.x - ax, wz = q.z - az, length2 = ex * ex + ez * ez;
    const double t = length2 > 0 ? std::clamp((wx * ex + wz * ez) / length2, 0.0, 1.0) : 0.0;
    best = std::min(best, hypotenuse(wx - t * ex, wz - t * ez));
    if ((az > q.z) != (az + ez > q.z) && q.x < ax + ex * (q.z - az) / ez) inside = !inside;
  }
  return corner(inside ? -best : best, std::abs(q.y) - realAt(p, 13));
}

double powerNorm(const std::array<double, 3>& u, double n) {
  const double m = std::max({u[0], u[1], u[2]});
  if (m <= 0) return 0;
  return m * detPow(detPow(u[0] / m, n) + detPow(u[1] / m, n) + detPow(u[2] / m, n), 1 / n);
}

double noiseOctave(Int3 o, int64_t period, uint32_t seed) {
  auto place = [&](int32_t v, int64_t& cell, double& f) {
    cell = v >= 0 ? v / period : -((-int64_t{v} + period - 1) / period);
    f = static_cast<double>(v - cell * period) / static_cast<double>(period);
  };
  std::array<int64_t, 3> cell{};
  std::array<double, 3> f{};
  for (int axis = 0; axis < 3; ++axis) place(o[axis], cell[static_cast<size_t>(axis)], f[static_cast<size_t>(axis)]);
  auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  double sum = 0;
  for (uint32_t k = 0; k < 8; ++k) {
    const std::array<uint32_t, 3> d{k & 1, k >> 1 & 1, k >> 2};
    uint32_t h = static_cast<uint32_t>(cell[0] + d[0]) * 0x9E3779B1u ^
                 static_cast<uint32_t>(cell[1] + d[1]) * 0x85EBCA77u ^
                 static_cast<uint32_t>(cell[2] + d[2]) * 0xC2B2AE3Du ^ seed;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    h = (h ^ h >> 12) * 0x297A2D39u;
    h ^= h >> 15;
    const uint32_t i = h & 15;
    const double x = f[0] - d[0], y = f[1] - d[1], z = f[2] - d[2];
    const double u = i < 8 ? x : y, v = i < 4 ? y : (i == 12 || i == 14) ? x : z;
    double weight = 1;
    for (size_t axis = 0; axis < 3; ++axis) weight *= d[axis] ? fade(f[axis]) : 1 - fade(f[axis]);
    sum += weight * ((i & 1 ? -u : u) + (i & 2 ? -v : v));
  }
  return sum;
}

double sweepShare(const uint32_t* p, Int3 at) {
  double best = 1e300, share = 0;
  for (uint32_t k = 0; k < p[0]; ++k) {
    const uint32_t* s = p + 1 + 9 * k;
    const auto [dx, dy, dz] = offsetFrom(s, at.x, at.y, at.z);
    const double ex = realAt(s, 3), ey = realAt(s, 4), ez = realAt(s, 5);
    const double length2 = ex * ex + ey * ey + ez * ez;
    const double t = length2 > 0 ? std::clamp((dx * ex + dy * ey + dz * ez) / length2, 0.0, 1.0) : 0.0;
    const double d = hypotenuse(dx - t * ex, dy - t * ey, dz - t * ez);
    if (d < best) {
      best = d;
      share = realAt(s, 7) + t * realAt(s, 8);
    }
  }
  return share;
}

double kernel(double x) {
  const double k = std::max(0.0, 1 - x);
  return k * k * k;
}

double roundUnion(double a, double b, double k) {
  const double u = std::clamp(k - a, 0.0, 1e9), v = std::clamp(k - b, 0.0, 1e9), nearest = std::min(a, b);
  return u > 0 && v > 0 ? std::min(nearest, k - hypotenuse(u, v)) : nearest;
}

// Clamps the result of an expression, as settleReal does (real.h).
double settle(double x) { return std::abs(x) < 1e-30 ? 0.0 : std::clamp(x, -1e18, 1e18); }

}  // namespace

double referenceNoise(const uint32_t* p, Int3 at) {
  auto wrapped = [](int32_t a, uint32_t b) { return static_cast<int32_t>(static_cast<uint32_t>(a) - b); };
  const Int3 o{wrapped(at.x, p[0]), wrapped(at.y, p[1]), wrapped(at.z, p[2])};
  double sum = 0, weight = realAt(p, 5);
  for (uint32_t k = 0; k < p[3]; ++k, weight *= 0.5) {
    sum += weight * noiseOctave(o, static_cast<int32_t>(p[6 + 2 * k]), p[4] + 0x9E3779B9u * k);
  }
  return std::clamp(sum, -1.0, 1.0);
}

double referencePrimitive(Op op, const uint32_t* p, double x, double y, double z) {
  const Local d = offset(p, x, y, z);
  switch (op) {
    case Op::sphere:
      return hypotenuse(d.x, d.y, d.z) - realAt(p, 4);
    case Op::blob:
      return kernel((d.x * d.x + d.y * d.y + d.z * d.z) * realAt(p, 4));
    case Op::capsule: {
      const double ax = realAt(p, 4), ay = realAt(p, 5), az = realAt(p, 6), length2 = ax * ax + ay * ay + az * az;
      const double t = length2 > 0 ? std::clamp((d.x * ax + d.y * ay + d.z * az) / length2, 0.0, 1.0) : 0.0;
      return hypotenuse(d.x - t * ax, d.y - t * ay, d.z - t * az) - realAt(p, 8);
    }
    default:
      break;
  }
  const Local q = toLocal(p, x, y, z);
  switch (op) {
    case Op::box: {
      const double ax = std::abs(q.x) - realAt(p, 13), ay = std::abs(q.y) - realAt(p, 14),
                   az = std::abs(q.z) - realAt(p, 15);
      return hypotenuse(std::max(ax, 0.0), std::max(ay, 0.0), std::max(az, 0.0)) +
             std::min(std::max({ax, ay, az}), 0.0);
    }
    case Op::cylinder:
      return corner(hypotenuse(q.x, q.z) - realAt(p, 13), std::abs(q.y) - realAt(p, 14));
    case Op::truncone:
      return trunconeDistance(hypotenuse(q.x, q.z), q.y, realAt(p, 13), realAt(p, 14), realAt(p, 15));
    case Op::torus:
      return hypotenuse(hypotenuse(q.x, q.z) - realAt(p, 13), q.y) - realAt(p, 14);
    case Op::ellipsoid:
      return (hypotenuse(q.x * realAt(p, 13), q.y * realAt(p, 14), q.z * realAt(p, 15)) - 1) * realAt(p, 16);
    case Op::superquadric:
      return (powerNorm({std::abs(q.x) * realAt(p, 13), std::abs(q.y) * realAt(p, 14), std::abs(q.z) * realAt(p, 15)},
                        realAt(p, 17)) -
              1) *
             realAt(p, 16);
    case Op::halfspace:
      return q.y;
    case Op::prism:
      return prismDistance(p, q);
    default:
      return 0;
  }
}

double referencePowerMorph(const uint32_t* p, double t, double x, double y, double z) {
  const Local q = toLocal(p, x, y, z);
  std::array<double, 3> radii{};
  for (int i = 0; i < 3; ++i) radii[static_cast<size_t>(i)] = (1 - t) * realAt(p, 13 + i) + t * realAt(p, 16 + i);
  const double n = 2 / (1 - t + t * realAt(p, 19));
  return (powerNorm({std::abs(q.x) / radii[0], std::abs(q.y) / radii[1], std::abs(q.z) / radii[2]}, n) - 1) *
         std::min({radii[0], radii[1], radii[2]});
}

double referenceField(const ProgramView& program, Int3 p) {
  double field = double{program.initial};
  std::array<double, kMaxRegisters> r{};
  std::array<Int3, kMaxPlaces> places{};
  places[0] = p;
  for (const ProgramGroup& g : program.groups) {
    for (const Instr& in : program.instrs.subspan(g.first, g.count)) {
      const uint32_t* params = program.params.data() + in.params;
      const Int3 at = places[in.place];
      double& out = r[in.op == Op::warp ? 0 : in.dst];
      const double a = r[in.a], b = r[in.b], c = r[in.c];
      switch (in.op) {
        case Op::constant:
          out = realAt(params, 0);
          break;
        case Op::coordinate: {
          const Local d = offset(params, at.x, at.y, at.z);
          out = realAt(params, 4) * d.x + realAt(params, 5) * d.y + realAt(params, 6) * d.z;
          break;
        }
        case Op::lattice:
          out = referenceLattice(params, at.x, at.y, at.z);
          break;
        case Op::noise:
          out = referenceNoise(params, at);
          break;
        case Op::sweep:
          out = sweepShare(params, at);
          break;
        case Op::power_morph:
          out = referencePowerMorph(params, std::clamp(a, 0.0, 1.0), at.x, at.y, at.z);
          break;
        case Op::copy:
          out = a;
          break;
        case Op::negate:
          out = -a;
          break;
        case Op::absolute:
          out = std::abs(a);
          break;
        case Op::floor:
          out = std::floor(std::clamp(a, -1e9, 1e9));
          break;
        case Op::square_root:
          out = std::sqrt(settle(std::max(a, 0.0)));
          break;
        case Op::add:
          out = settle(a + b);
          break;
        case Op::subtract:
          out = settle(a - b);
          break;
        case Op::multiply:
          out = settle(settle(a) * settle(b));
          break;
        case Op::divide:
          out = settle(b) == 0 ? 0 : settle(settle(a) * std::clamp(1 / settle(b), -1e18, 1e18));
          break;
        case Op::less:
          out = a < b ? 1 : 0;
          break;
        case Op::smoothstep: {
          const double t = std::clamp((a - realAt(params, 0)) * realAt(params, 1), 0.0, 1.0);
          out = t * t * (3 - 2 * t);
          break;
        }
        case Op::mix:
          out = settle((1 - c) * a + c * b);
          break;
        case Op::minimum:
          out = std::min(a, b);
          break;
        case Op::maximum:
          out = std::max(a, b);
          break;
        case Op::cut:
          out = std::max(a, -b);
          break;
        case Op::morph: {
          const double t = std::clamp(c, 0.0, 1.0);
          out = (1 - t) * a + t * b;
          break;
        }
        case Op::displace:
          out = settle(a + 1024 * b);
          break;
        case Op::kernel: {
          const double s = std::clamp(1 + a * realAt(params, 0), 0.0, 1e9);
          out = kernel(s * s * realAt(params, 1));
          break;
        }
        case Op::round_begin:
          out = double{kFar};
          r[in.b] = 0;
          break;
        case Op::round_add: {
          const double h = std::clamp(realAt(params, 0) - a, 0.0, 1e9);
          out = std::min(out, a);
          r[in.b] += h * h;
          break;
        }
        case Op::round_end:
          out = std::max(a, realAt(params, 0)) - std::sqrt(b);
          break;
        case Op::sum_begin:
          out = 0;
          r[in.b] = 0;
          break;
        case Op::sum_add:
          out = std::max(out, a);
          r[in.b] += a;
          break;
        case Op::sum_end:
          out = (realAt(params, 0) - b) * realAt(params, 1);
          break;
        case Op::warp: {
          auto move = [](int32_t v, double w) {
            const double m = std::floor(std::clamp(w, -1048576.0, 1048576.0) * 1024 + 0.5);
            return static_cast<int32_t>(static_cast<uint32_t>(v) + static_cast<uint32_t>(static_cast<int32_t>(m)));
          };
          places[in.dst] = {move(at.x, a), move(at.y, b), move(at.z, c)};
          break;
        }
        default:
          out = referencePrimitive(in.op, params, at.x, at.y, at.z);
          break;
      }
    }
    if (g.guarded && !g.influence.contains(p)) continue;
    if (g.smooth > 0) {
      const double joined = roundUnion(g.cut ? -field : field, r[g.result], double{g.smooth});
      field = g.cut ? -joined : joined;
      continue;
    }
    // Cutting the groups one after another, max(f, -g), is the same as removing their union.
    field = g.cut ? std::max(field, -r[g.result]) : std::min(field, r[g.result]);
  }
  return field;
}

}  // namespace sgm
