// Tests the camera that the mouse and keys move.

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "catch.h"
#include "rounds.h"
#include "tools/preview/free_camera.h"

using namespace sgm;
using namespace sgm::preview;

namespace {

using Gaze = FreeCamera::Gaze;

glm::dvec3 at(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }
glm::dvec3 along(const Gaze& gaze) { return at(gaze[1]) - at(gaze[0]); }
bool near(const std::array<double, 3>& a, const std::array<double, 3>& b) { return glm::distance(at(a), at(b)) < 1e-9; }

Gaze randomGaze(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-100, 100);
  Gaze gaze{};
  do {
    for (auto& point : gaze)
      for (double& axis : point) axis = place(random);
    // Vertical directions are excluded: they have no heading, and the camera never looks exactly along them.
  } while (std::hypot(gaze[1][0] - gaze[0][0], gaze[1][2] - gaze[0][2]) < 20);
  return gaze;
}

}  // namespace

TEST_CASE("a camera keeps the gaze that it is given", "[preview]") {
  std::mt19937 random(7);
  for (unsigned i = 0; i < rounds(200); ++i) {
    CAPTURE(i);
    const Gaze gaze = randomGaze(random);
    const FreeCamera camera(gaze, i % 2 == 0);
    CHECK(near(camera.gaze()[0], gaze[0]));
    CHECK(near(camera.gaze()[1], gaze[1]));
  }
}

TEST_CASE("in a hollow the camera stays where it is, outside its target does", "[preview]") {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> angle(-2, 2);
  for (unsigned i = 0; i < rounds(200); ++i) {
    CAPTURE(i);
    const Gaze gaze = randomGaze(random);
    const bool inside = i % 2 == 0;
    FreeCamera camera(gaze, inside);
    const double right = angle(random), up = angle(random);
    camera.turn(right, up);
    CHECK(near(camera.gaze()[inside ? 0 : 1], gaze[inside ? 0 : 1]));
    CHECK(glm::length(along(camera.gaze())) == Approx(glm::length(along(gaze))));
    // The camera stops at the vertical, however far it is turned.
    camera.turn(0, inside ? -50 : 50);
    CHECK(along(camera.gaze()).y < glm::length(along(camera.gaze())));
    CHECK(along(camera.gaze()).y > 0.99 * glm::length(along(camera.gaze())));
  }
}

TEST_CASE("what is dragged follows the pointer", "[preview]") {
  const Gaze gaze{{{0, 2, 10}, {0, 2, 0}}};
  for (const bool inside : {true, false}) {
    CAPTURE(inside);
    // Inside a hollow, the ray hits the wall straight ahead; outside, it hits the near side.
    const glm::dvec3 seen = inside ? glm::dvec3(0, 2, 0) : glm::dvec3(0, 2, 1);
    FreeCamera camera(gaze, inside);
    camera.turn(0.1, 0.1);
    const glm::dvec3 forward = glm::normalize(along(camera.gaze()));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    CHECK(glm::dot(seen - at(camera.gaze()[0]), right) > 0);
    CHECK(glm::dot(seen - at(camera.gaze()[0]), glm::cross(right, forward)) > 0);
  }
}

TEST_CASE("a camera moves along its picture's axes and comes nearer", "[preview]") {
  FreeCamera camera({{{0, 0, 10}, {0, 0, 0}}}, false);
  camera.move(1, 2, 3);
  CHECK(near(camera.gaze()[0], {1, 2, 7}));
  CHECK(near(camera.gaze()[1], {1, 2, -3}));
  camera.approach(0.5);
  CHECK(near(camera.gaze()[0], {1, 2, 2}));
  CHECK(near(camera.gaze()[1], {1, 2, -3}));
  FreeCamera inside({{{0, 0, 10}, {0, 0, 0}}}, true);
  inside.approach(0.5);
  CHECK(near(inside.gaze()[0], {0, 0, 5}));
  CHECK(near(inside.gaze()[1], {0, 0, -5}));
}

TEST_CASE("rays go through the places of a picture", "[preview]") {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0, 1), far(1, 50);
  for (unsigned i = 0; i < rounds(200); ++i) {
    CAPTURE(i);
    const Gaze gaze = randomGaze(random);
    const double fov = 0.3 + 1.5 * unit(random), aspect = 0.5 + 2 * unit(random), x = unit(random), y = unit(random);
    const glm::dvec3 ray = rayThrough(gaze, fov, aspect, x, y);
    // Projecting the point back gives the same place in the picture.
    const glm::dvec3 forward = glm::normalize(along(gaze));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0))), up = glm::cross(right, forward);
    const glm::dvec3 seen = far(random) * ray;
    const double half = std::tan(fov / 2), depth = glm::dot(seen, forward);
    CHECK((glm::dot(seen, right) / depth / half / aspect + 1) / 2 == Approx(x).margin(1e-9));
    CHECK((1 - glm::dot(seen, up) / depth / half) / 2 == Approx(y).margin(1e-9));
  }
}
