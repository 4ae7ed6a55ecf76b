#include "derive/layout/split_layout.h"

#include <algorithm>

#include "base/math.h"

namespace sgm {
namespace {

constexpr double kSlack = 1e-9;  // tolerance for rounding errors, in metres and in numbers of repetitions

struct Sums {
  double rigid = 0, flexible = 0;
  size_t parts = 0;
};

/// Returns how often the repeated group fits into the length that the other parts leave.
double repetitionsOf(double length, const Sums& others, const Sums& group) {
  const double once = group.rigid + group.flexible;
  if (!(once > 0)) return 0;
  const double fits = (length - others.rigid - others.flexible) / once;
  double count = group.flexible > 0 ? std::max(1.0, detFloor(fits + 0.5)) : detFloor(fits + kSlack);
  if (group.rigid > 0) count = std::min(count, detFloor((length - others.rigid) / group.rigid + kSlack));
  return std::max(0.0, count);
}

}  // namespace

SplitLayout layOut(double length, std::span<const SplitSize> parts, size_t most) {
  Sums others, group;
  for (const SplitSize& part : parts) {
    Sums& sums = part.repeated ? group : others;
    (part.flexible ? sums.flexible : sums.rigid) += part.size;
    ++sums.parts;
  }
  SplitLayout out;
  const double count = repetitionsOf(length, others, group);
  out.repetitions = count;
  out.too_many =
      !(count * static_cast<double>(group.parts) + static_cast<double>(others.parts) <= static_cast<double>(most));
  if (out.too_many) return out;
  const double rest = length - others.rigid - count * group.rigid;
  const double wanted = others.flexible + count * group.flexible;
  const double stretch = rest > 0 && wanted > 0 ? rest / wanted : 0;
  out.cut_off = rest < -kSlack;
  double at = 0;
  const auto place = [&](uint32_t part, uint32_t repetition) {
    double size = parts[part].size * (parts[part].flexible ? stretch : 1);
    if (at + size > length + kSlack) size = length - at;
    if (!(size > kSlack)) return;
    out.places.push_back({part, repetition, at + 0.5 * size, size});
    at += size;
  };
  const uint32_t end = static_cast<uint32_t>(parts.size());
  for (uint32_t part = 0; part < end;) {
    if (!parts[part].repeated) {
      place(part++, 0);
      continue;
    }
    uint32_t behind = part;
    while (behind < end && parts[behind].repeated) ++behind;
    for (uint32_t i = 0; i < count; ++i)
      for (uint32_t p = part; p < behind; ++p) place(p, i);
    part = behind;
  }
  return out;
}

}  // namespace sgm
