// Tests fans of lateral edges for all 256 combinations of fine and coarse octants around a corner.

#include <array>
#include <bit>
#include <set>

#include "catch.h"
#include "mesh/fans.h"

using namespace sgm;

namespace {

/// One of the 12 quads around the corner. One coordinate of its centre is 0, the others are 1 or -1; the octants and
/// half axes that the quad touches follow from the centre.
struct Quad {
  std::array<int, 3> centre{};
  int below() const {
    int o = 0;
    for (int i = 0; i < 3; ++i) o |= (centre[static_cast<size_t>(i)] > 0 ? 1 : 0) << i;
    return o;
  }
  int axis() const {
    for (int i = 0; i < 3; ++i)
      if (centre[static_cast<size_t>(i)] == 0) return i;
    return -1;
  }
  bool touches(int half_axis) const {
    return centre[static_cast<size_t>(half_axis / 2)] == (half_axis % 2 == 0 ? -1 : 1);
  }
};

std::array<Quad, 12> quads() {
  std::array<Quad, 12> list;
  for (size_t q = 0; q < 12; ++q) {
    size_t bit = 0;
    for (size_t i = 0; i < 3; ++i)
      if (i != q / 4) list[q].centre[i] = (q >> bit++ & 1) != 0 ? 1 : -1;
  }
  return list;
}

}  // namespace

TEST_CASE("fans are the cycles of interface quads around a corner", "[mesh][fans]") {
  const std::array<Quad, 12> all = quads();
  size_t bad = 0, checked = 0, with_two_fans = 0;
  for (unsigned coarser = 0; coarser < 256; ++coarser) {
    std::vector<size_t> interface;
    for (size_t q = 0; q < 12; ++q) {
      const int below = all[q].below(), above = below | 1 << all[q].axis();
      if (((coarser >> below ^ coarser >> above) & 1) != 0) interface.push_back(q);
    }
    bool checkerboard = false;
    for (int h = 0; h < 6; ++h) {
      const auto here = std::count_if(interface.begin(), interface.end(), [&](size_t q) { return all[q].touches(h); });
      bad += here % 2 != 0;
      checkerboard |= here == 4;
    }
    if (checkerboard) continue;
    // These quads form cycles: every quad touches two half axes, and at each of them it meets exactly one other quad.
    // Follows each cycle, beginning with its quad of lowest number.
    std::set<size_t> left(interface.begin(), interface.end());
    std::set<int> fans;
    while (!left.empty()) {
      const size_t start = *left.begin();
      fans.insert(static_cast<int>(start));
      for (size_t at = start, from = 6;;) {
        left.erase(at);
        bad += lateralFan(static_cast<uint8_t>(coarser), static_cast<int>(at)) != static_cast<int>(start);
        ++checked;
        size_t half_axis = 0;
        while (half_axis == from || !all[at].touches(static_cast<int>(half_axis))) ++half_axis;
        at = *std::find_if(interface.begin(), interface.end(),
                           [&](size_t q) { return q != at && all[q].touches(static_cast<int>(half_axis)); });
        from = half_axis;
        if (at == start) break;
      }
    }
    with_two_fans += fans.size() > 1;
  }
  CHECK(bad == 0);
  CHECK(checked > 500);
  CHECK(with_two_fans > 0);
}

TEST_CASE("the four seam cells at a checkerboard share a fan", "[mesh][fans]") {
  const std::array<Quad, 12> all = quads();
  size_t checkerboards = 0;
  for (unsigned coarser = 0; coarser < 256; ++coarser) {
    for (int h = 0; h < 6; ++h) {
      std::set<int> fans;
      size_t here = 0;
      for (size_t q = 0; q < 12; ++q) {
        const int below = all[q].below(), above = below | 1 << all[q].axis();
        if (!all[q].touches(h) || ((coarser >> below ^ coarser >> above) & 1) == 0) continue;
        ++here;
        fans.insert(lateralFan(static_cast<uint8_t>(coarser), static_cast<int>(q)));
      }
      if (here != 4) continue;
      ++checkerboards;
      INFO("coarser octants " << coarser << ", half axis " << h);
      CHECK(fans.size() == 1);
    }
  }
  // For each of the six half axes, two of the 16 states of its four octants are checkerboards.
  CHECK(checkerboards == 6 * 2 * 16);
}

TEST_CASE("inside a face there is one fan, whatever is around the chunk", "[mesh][fans]") {
  for (int f = 0; f < 6; ++f) {
    const auto face = static_cast<Face>(f);
    const int lowest = 4 * faceAxis(face);
    for (Neighbourhood around : {Neighbourhood{0}, neighbourBit(face), (Neighbourhood{1} << 27) - 1})
      CHECK(int{seamFans(face, around)[1][1]} == lowest);
  }
}

TEST_CASE("the blocks across faces") {
  CHECK(neighboursAcross(0) == 0);
  CHECK(neighboursAcross(1u << static_cast<int>(Face::y_hi)) == neighbourBit(0, 1, 0));
  CHECK(neighboursAcross(63) == (neighbourBit(-1, 0, 0) | neighbourBit(1, 0, 0) | neighbourBit(0, -1, 0) |
                                 neighbourBit(0, 1, 0) | neighbourBit(0, 0, -1) | neighbourBit(0, 0, 1)));
}
