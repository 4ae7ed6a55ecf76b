// Tests meshes of fitted assets: closed and connected in every size, with the volume of the exact body.

#include <cmath>
#include <random>

#include "asset/fit.h"
#include "bodies.h"
#include "compile_text.h"
#include "glb_bytes.h"
#include "metrics_fixture.h"
#include "rounds.h"

using namespace sgm;
using namespace sgm::test;

namespace {

std::string metres(double value) { return std::to_string(value) + "m"; }

}  // namespace

TEST_CASE("a fitted asset is closed and of one piece in every size, and has its volume", "[fit]") {
  const std::pair<const char*, asset::TriangleMesh> assets[] = {
      {"bay", asset::archedBay(6)}, {"house", asset::gabledHouse()}, {"wall", asset::windowedWall(2, 1)}};
  unsigned closed = 0;
  for (unsigned seed = 0; seed < rounds(24); ++seed) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() % 10001) / 10000;
    };
    const auto& [name, mesh] = assets[seed % 3];
    const asset::Polyhedron solid = asset::solidOf(mesh);
    // No size is both wide and low: otherwise less than a cell of solid could remain above an arch.
    const asset::Point size{between(3, 5.5), between(5, 8), between(1, 4)};
    std::vector<asset::FitZone> zones;
    std::string text = std::string("fit ") + name;
    if (seed % 3 != 1 && random() % 2 == 0) {
      zones.push_back({0, true, 0.25, solid.high.x - solid.low.x - 0.25});
      text += " repeat x 0.25m.." + metres(zones[0].to);
    }
    const auto body = asset::fitInto(solid, size, zones);
    if (!body) continue;
    const double turned = between(0, 90);
    const std::string grammar = std::string("sgm 1; import \"") + name + ".glb\" as " + name +
                                "; start A; rule A { rot(y, " + std::to_string(turned) + "deg) size(" + metres(size.x) +
                                ", " + metres(size.y) + ", " + metres(size.z) + ") " + text + "; }";
    CAPTURE(seed, grammar);
    MapResolver files;
    files.files[std::string(name) + ".glb"] = asset::glbOf(mesh);
    const World world(grammar, &files);
    const IntBox box = world.program().domain.box;
    // The box that the compiler computes for the domain contains the scope rotated by any angle, and exceeds it by at
    // most about 1 m.
    const double half = 0.5 * std::sqrt(size.x * size.x + size.z * size.z) + 1.1;
    CHECK(box.hi.x <= half * kMetre);
    CHECK(box.hi.y <= (0.5 * size.y + 1.1) * kMetre);
    const RegionMeasures found = world.measured(0.0625, box);
    INFO(found.topology.leak);
    CHECK(found.topology.watertight);
    CHECK(found.topology.genus.has_value());
    CHECK(found.pieces.solid.size() == 1);
    CHECK(found.volume == Approx(body->volume()).epsilon(0.04));
    ++closed;
  }
  CHECK(closed >= rounds(24) / 2);
}
