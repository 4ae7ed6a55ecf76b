#include "evaluated_points.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sgm {

PointSet randomPoints(std::mt19937& random, Int3 centre, int32_t extent, size_t count) {
  PointSet s;
  auto axis = [&](int32_t c) {
    const auto offset = static_cast<int64_t>(random() % (2u * static_cast<uint32_t>(extent))) - extent;
    return saturate(int64_t{c} + offset);
  };
  for (size_t i = 0; i < count; ++i) {
    s.x.push_back(axis(centre.x));
    s.y.push_back(axis(centre.y));
    s.z.push_back(axis(centre.z));
  }
  return s;
}

PointSet gridPoints(const IntBox& box, int32_t step) {
  PointSet s;
  for (int64_t z = box.lo.z; z <= box.hi.z; z += step) {
    for (int64_t y = box.lo.y; y <= box.hi.y; y += step) {
      for (int64_t x = box.lo.x; x <= box.hi.x; x += step) {
        s.x.push_back(static_cast<int32_t>(x));
        s.y.push_back(static_cast<int32_t>(y));
        s.z.push_back(static_cast<int32_t>(z));
      }
    }
  }
  return s;
}

Evaluated evaluate(const FieldKernels& kernels, const ProgramView& program, const Points& points) {
  Evaluated e;
  const size_t n = points.count;
  e.q.resize(n);
  e.value.resize(n);
  e.gx.resize(n);
  e.gy.resize(n);
  e.gz.resize(n);
  e.nx.resize(n);
  e.ny.resize(n);
  e.label.resize(n);
  EvalScratch scratch;
  kernels.samples(program, points, scratch, e.q.data());
  kernels.attributes(program, points, scratch,
                     {e.value.data(), e.gx.data(), e.gy.data(), e.gz.data(), e.nx.data(), e.ny.data(), e.label.data()});
  return e;
}

bool shows(const Evaluated& e) {
  return std::any_of(e.value.begin(), e.value.end(), [](float v) { return std::abs(v) != kFar; });
}

size_t differentBits(const Evaluated& a, const Evaluated& b) {
  size_t different = 0;
  auto compare = [&](const auto& u, const auto& v) {
    if (u.size() != v.size()) {
      different += u.size() + v.size();
      return;
    }
    for (size_t i = 0; i < u.size(); ++i) different += std::memcmp(&u[i], &v[i], sizeof u[i]) != 0;
  };
  compare(a.q, b.q);
  compare(a.value, b.value);
  compare(a.gx, b.gx);
  compare(a.gy, b.gy);
  compare(a.gz, b.gz);
  compare(a.nx, b.nx);
  compare(a.ny, b.ny);
  compare(a.label, b.label);
  return different;
}

}  // namespace sgm
