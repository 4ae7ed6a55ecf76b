#include "scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace bench {
namespace {

constexpr int32_t kUnits = 1024;
constexpr int32_t kEdge = 64 * kUnits;  // edge of the cube that the synthetic scenes fill, in units; the cube is
                                        // centred on the origin

// Returns a counter-based random number (the finaliser of splitmix64), so that scenes do not depend on any library's
// generator.
uint64_t draw(uint64_t counter) {
  uint64_t x = counter * 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}
int32_t within(uint64_t counter, int32_t lo, int32_t hi) {
  return lo + static_cast<int32_t>(draw(counter) % static_cast<uint64_t>(hi - lo + 1));
}

// Formats a length in units as metres, exactly: 1/1024 has ten decimals.
std::string metres(int32_t units) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10fm", units / double{kUnits});
  return text;
}

Ball ball(uint64_t seed, uint64_t index, int32_t least, int32_t most) {
  const uint64_t counter = seed * 1000003u + index * 4u;
  Ball made{};
  made.radius = within(counter, least, most);
  const int32_t far = kEdge / 2 - 2 * made.radius - kUnits;
  for (uint64_t axis = 0; axis < 3; ++axis) made.centre[axis] = within(counter + 1 + axis, -far, far);
  return made;
}

std::string point(const int32_t (&p)[3]) { return metres(p[0]) + ", " + metres(p[1]) + ", " + metres(p[2]); }
std::string text(const Ball& b) { return "  at(" + point(b.centre) + ") sphere(" + metres(b.radius) + ");\n"; }

std::string capsules(uint64_t count) {
  std::string lines;
  for (uint64_t i = 0; i < count; ++i) {
    const uint64_t counter = 3 * 1000003u + i * 8u;
    int32_t from[3], to[3];
    for (uint64_t axis = 0; axis < 3; ++axis) {
      from[axis] = within(counter + axis, -27 * kUnits, 27 * kUnits);
      to[axis] =
          std::clamp(from[axis] + within(counter + 3 + axis, -9 * kUnits, 9 * kUnits), -27 * kUnits, 27 * kUnits);
    }
    lines += "    capsule((" + point(from) + "), (" + point(to) + "), " +
             metres(within(counter + 6, kUnits, 2 * kUnits)) + ");\n";
  }
  return lines;
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

Ball blobAt(uint64_t i) { return ball(1, i, 2 * kUnits, 4 * kUnits); }

Scene makeScene(const std::string& name, int cells, const std::string& cave_path) {
  const bool power = cells >= 32 && cells <= 2048 && std::has_single_bit(static_cast<unsigned>(cells));
  if (!power && !(name == "world" && cells >= 32 && cells % 32 == 0))
    throw std::runtime_error("no cube of " + name + " has " + std::to_string(cells) +
                             " cells on an edge; give a power of two from 32 to 2048 (of world a multiple of 32)");
  // The cave has a fixed size of 128 m and contains a chamber; with 256 cells along an edge, a cell is 0.5 m.
  if (name == "cave") return {name, readText(cave_path), 128 * kUnits / cells, {kEdge, kEdge, kEdge}};
  if (name == "world") return {name, readText(cave_path), kUnits / 2, {kEdge, kEdge, kEdge}};
  std::string body;
  if (name == "sphere") {
    body = "  sphere(25m);\n";
  } else if (name == "blobs") {
    body = "  sum {\n";
    for (uint64_t i = 0; i < kBlobs; ++i) body += text(blobAt(i));
    body += "  }\n";
  } else if (name == "caves") {
    const std::string cut =
        "  displace rock.fbm(period 5m, amp 0.5m) {\n   union smooth 1m {\n" + capsules(300) + "   }\n  }\n";
    const int32_t low = -kEdge / 2;
    return {name,
            "sgm 1;\nimport \"std/rock.sgm\" as rock;\nunits m;\nstart Scene;\nrule Scene {\n" + cut + "}\n",
            kEdge / cells,
            {low, low, low}};
  } else if (name == "spheres") {
    for (uint64_t i = 0; i < 1000; ++i) body += text(ball(2, i, kUnits, 5 * kUnits / 2));
  } else if (name.starts_with("spheres:")) {
    const uint64_t count = std::strtoull(name.c_str() + std::strlen("spheres:"), nullptr, 10);
    if (count < 1) throw std::runtime_error("spheres:N needs a number from 1 on");
    const double scale = std::cbrt(1000.0 / static_cast<double>(count));
    const auto units = [&](double metres) { return static_cast<int32_t>(std::lround(metres * scale * kUnits)); };
    const int32_t far = std::max(kUnits, kEdge / 2 - 2 * units(2.5) - kUnits);
    const std::string anywhere = "rand(-" + metres(far) + ", " + metres(far) + ")";
    body = "  for i in 1.." + std::to_string(count) + " { at(" + anywhere + ", " + anywhere + ", " + anywhere +
           ") sphere(rand(" + metres(units(1)) + ", " + metres(units(2.5)) + ")); }\n";
  } else {
    throw std::runtime_error("no scene is called " + name +
                             "; there are sphere, blobs, caves, spheres, spheres:N, cave, world");
  }
  const int32_t low = -kEdge / 2;
  return {name, scene(body), kEdge / cells, {low, low, low}};
}

}  // namespace bench
