#include "scene.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace bench {
namespace {

constexpr int32_t kUnits = 1024;
constexpr int32_t kEdge = 64 * kUnits;  // of the cube that the synthetic scenes fill, centred on the origin

// A counter-based draw (the finaliser of splitmix64), so that no library's generator enters the scenes.
uint64_t draw(uint64_t counter) {
  uint64_t x = counter * 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}
int32_t within(uint64_t counter, int32_t lo, int32_t hi) {
  return lo + static_cast<int32_t>(draw(counter) % static_cast<uint64_t>(hi - lo + 1));
}

// Units as metres, exactly: 1/1024 has ten decimals.
std::string metres(int32_t units) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10fm", units / double{kUnits});
  return text;
}

std::string ball(uint64_t seed, uint64_t index, int32_t least, int32_t most) {
  const uint64_t counter = seed * 1000003u + index * 4u;
  const int32_t r = within(counter, least, most);
  const int32_t far = kEdge / 2 - 2 * r - kUnits;
  std::string line = "  at(";
  for (uint64_t axis = 0; axis < 3; ++axis)
    line += metres(within(counter + 1 + axis, -far, far)) + (axis < 2 ? ", " : ")");
  return line + " sphere(" + metres(r) + ");\n";
}

std::string scene(const std::string& body) { return "sgm 1;\nunits m;\nstart Scene;\nrule Scene {\n" + body + "}\n"; }

std::string readText(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

std::vector<Scene> makeScenes(int cells, const std::string& cave_path) {
  std::string blobs = "  sum {\n", spheres;
  for (uint64_t i = 0; i < 200; ++i) blobs += ball(1, i, 2 * kUnits, 4 * kUnits);
  for (uint64_t i = 0; i < 1000; ++i) spheres += ball(2, i, kUnits, 5 * kUnits / 2);
  blobs += "  }\n";

  const int32_t cell = kEdge / cells;
  const int32_t low = -kEdge / 2;
  // The cave has its own scale: half a metre a cell at 256 cells, so that every size sees the same 128 m, with a chamber.
  const int32_t cave_cell = 128 * kUnits / cells;
  return {
      {"sphere", scene("  sphere(25m);\n"), cell, {low, low, low}},
      {"blobs", scene(blobs), cell, {low, low, low}},
      {"spheres", scene(spheres), cell, {low, low, low}},
      {"cave", readText(cave_path), cave_cell, {kEdge, kEdge, kEdge}},
  };
}

}  // namespace bench
