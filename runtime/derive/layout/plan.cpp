#include "derive/layout/plan.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "derive/draws.h"
#include "grammar/syntax/profile_limits.h"

namespace sgm {
namespace {

double turnAt(PlanCorner a, PlanCorner b, PlanCorner c) {
  return (b.x - a.x) * (c.z - b.z) - (b.z - a.z) * (c.x - b.x);
}

/// Returns the outward unit normal of an edge; 0 if its corners coincide.
PlanCorner outward(PlanCorner from, PlanCorner to) {
  const Vec3 out = normalised({to.z - from.z, 0, from.x - to.x});
  return {out.x, out.z};
}

/// True if two edges without a common corner cross.
bool crosses(const std::vector<PlanCorner>& at) {
  const size_t count = at.size();
  const auto apart = [&](size_t edge, PlanCorner a, PlanCorner b) {
    const PlanCorner from = at[edge], to = at[(edge + 1) % count];
    return turnAt(from, to, a) * turnAt(from, to, b) < 0;
  };
  for (size_t i = 0; i < count; ++i)
    for (size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j + 1 == count) continue;
      if (apart(i, at[j], at[(j + 1) % count]) && apart(j, at[i], at[(i + 1) % count])) return true;
    }
  return false;
}

}  // namespace

PlanPiece rectPiece(double x, double z) {
  PlanPiece piece;
  piece.x = x;
  piece.z = z;
  piece.rect = true;
  const double a = 0.5 * x, b = 0.5 * z;
  piece.corners = {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
  return piece;
}

PlanPiece regularPiece(int corners, double radius) {
  PlanPiece piece;
  for (int i = 0; i < corners; ++i) {
    const double angle = kPi * (1 - 2 * i) / corners;
    piece.corners.push_back({radius * detSin(angle), radius * detCos(angle)});
    piece.x = std::max(piece.x, 2 * std::fabs(piece.corners.back().x));
    piece.z = std::max(piece.z, 2 * std::fabs(piece.corners.back().z));
  }
  return piece;
}

PlanPiece polygonPiece(std::span<const PlanCorner> corners) {
  PlanPiece piece;
  PlanCorner low = corners[0], high = corners[0];
  double area = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const PlanCorner a = corners[i], b = corners[(i + 1) % corners.size()];
    low = {std::min(low.x, a.x), std::min(low.z, a.z)};
    high = {std::max(high.x, a.x), std::max(high.z, a.z)};
    area += (a.x - corners[0].x) * (b.z - corners[0].z) - (b.x - corners[0].x) * (a.z - corners[0].z);
  }
  piece.middle = {0.5 * (low.x + high.x), 0.5 * (low.z + high.z)};
  piece.x = high.x - low.x;
  piece.z = high.z - low.z;
  for (const PlanCorner& c : corners) piece.corners.push_back({c.x - piece.middle.x, c.z - piece.middle.z});
  if (area < 0) std::reverse(piece.corners.begin(), piece.corners.end());
  return piece;
}

void putOnOutline(PlanPiece& piece, const PlanPiece& other, PathKey key) {
  const size_t count = other.corners.size();
  const size_t edge = std::min(static_cast<size_t>(key.unit(kOutlineDraw) * static_cast<double>(count)), count - 1);
  const double along = key.unit(kAlongDraw);
  const PlanCorner a = other.corners[edge], b = other.corners[(edge + 1) % count];
  piece.middle = {other.middle.x + a.x + along * (b.x - a.x), other.middle.z + a.z + along * (b.z - a.z)};
}

bool isConvex(const PlanPiece& piece) {
  const size_t count = piece.corners.size();
  const double slack = -1e-9 * piece.x * piece.z;
  for (size_t i = 0; i < count; ++i)
    if (turnAt(piece.corners[i], piece.corners[(i + 1) % count], piece.corners[(i + 2) % count]) < slack) return false;
  return true;
}

bool isSimple(const PlanPiece& piece) {
  const std::vector<PlanCorner>& at = piece.corners;
  double area = 0;
  for (size_t i = 0; i < at.size(); ++i) area += turnAt(at[0], at[i], at[(i + 1) % at.size()]);
  return area > 1e-9 * piece.x * piece.z && !crosses(at);
}

bool isSimple(const PlanPiece& piece, const std::vector<PlanCorner>& grown) {
  for (size_t i = 0; i < grown.size(); ++i) {
    const size_t next = (i + 1) % grown.size();
    const PlanCorner a = piece.corners[i], b = piece.corners[next];
    if ((b.x - a.x) * (grown[next].x - grown[i].x) + (b.z - a.z) * (grown[next].z - grown[i].z) < 0) return false;
  }
  return !crosses(grown);
}

std::vector<PlanCorner> grownOutline(const PlanPiece& piece, double margin) {
  std::vector<PlanCorner> out = piece.corners;
  const size_t count = out.size();
  for (size_t i = 0; i < count && margin > 0; ++i) {
    const PlanCorner at = piece.corners[i];
    const PlanCorner a = outward(piece.corners[(i + count - 1) % count], at);
    const PlanCorner b = outward(at, piece.corners[(i + 1) % count]);
    // The new corner is the intersection of the two adjacent edges, each moved outwards by the margin.
    const double x = a.x + b.x, z = a.z + b.z;
    const double share = std::max(1 + a.x * b.x + a.z * b.z, std::sqrt(x * x + z * z) / kMaxMiter);
    if (share > 0) out[i] = {at.x + margin * x / share, at.z + margin * z / share};
  }
  return out;
}

}  // namespace sgm
