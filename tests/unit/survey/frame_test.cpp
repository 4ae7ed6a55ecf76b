// Tests the search for the uses of a rule (places where derivation applies it), and the choice of a camera that shows
// such a place.

#include "tools/framing/frame_camera.h"

#include <glm/trigonometric.hpp>

#include "scenes.h"
#include "tools/framing/rule_frame.h"
#include "world/world_support.h"

using namespace sgm;
using namespace sgm::cli;

namespace {

constexpr const char* kPosts = R"(sgm 1;
import "std/cave.sgm" as cave;
units m;
domain infinite axes xz;
layer rows cell 32m reach 8m { start Row; }
rule Row { for i in 0..3 { at(8m + 8m*i, 2m, 16m) Post(1m + 0.5m*i); } at(16m, -1m, 16m) box(33m, 2m, 33m); }
rule Post(h) { box(1m, 2*h, 1m); }
rule Nothing { }
)";

std::string why(const Result<FramedRule>& result) { return result ? std::string() : result.error().message; }

void add(TestMesh& mesh, const TestMesh& other) {
  const auto base = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const uint32_t index : other.indices) mesh.indices.push_back(base + index);
}

FrameTarget targetOf(const TestMesh& mesh, glm::vec3 centre, float radius, uint32_t first = 0) {
  FrameTarget target{centre - radius, centre + radius, {}};
  for (uint32_t i = 0; i < mesh.indices.size() / 3; ++i) target.triangles.push_back(first + i);
  return target;
}

std::optional<FramedView> frame(const TestMesh& mesh, std::span<const FrameTarget> targets, const RenderCamera& request,
                                const std::function<bool(glm::vec3)>& isOpen) {
  Result<std::optional<FramedView>> view = frameTargets(mesh.vertices, mesh.indices, targets, request, isOpen);
  REQUIRE(view);
  return *view;
}

}  // namespace

TEST_CASE("a rule is found by its name, by its import's, and by a path", "[frame]") {
  const WorldFieldSettings settings = settingsOf(kPosts, 512);
  const Program& program = *settings.program;
  REQUIRE(findFramedRule(program, "Post"));
  REQUIRE(findFramedRule(program, "cave.Column"));
  CHECK(findFramedRule(program, "Row/Post[2]")->by_path);
  CHECK(why(findFramedRule(program, "Pots")) == "--frame: there is no rule 'Pots': did you mean 'Post'?");
  CHECK(why(findFramedRule(program, "Column")) == "--frame: there is no rule 'Column': did you mean 'cave.Column'?");
  CHECK(why(findFramedRule(program, "cave.Colum")).ends_with("did you mean 'cave.Column'?"));
  CHECK(why(findFramedRule(program, "Elephant")).find("the grammar has ") != std::string::npos);
  CHECK(why(findFramedRule(program, "Row//Post")).find("expected") != std::string::npos);
  CHECK(why(findFramedRule(program, "")).find("expected") != std::string::npos);
}

TEST_CASE("paths are matched from their ends", "[frame]") {
  const char* path = "rows(0, 0, -1)/Row/cave.Post[2]";
  for (const char* wanted : {"Post", "cave.Post", "Post[2]", "Row/Post[2]", "rows(0, 0, -1)/Row/Post"})
    CHECK(matchesPath(wanted, path));
  for (const char* wanted :
       {"Post[1]", "Column", "rock.Post", "Row", "A/Row/Post", "rows(0, 0, 0)/Row/Post", "rows(0, 0, -1)/Post"})
    CHECK_FALSE(matchesPath(wanted, path));
}

TEST_CASE("uses have bounds, and a region around one of them", "[frame]") {
  const WorldField world(settingsOf(kPosts, 512), std::pmr::new_delete_resource());
  const Program& program = *world.settings().program;
  const IntBox box{{0, -8192, 0}, {32767, 8192, 32767}};
  const Result<std::vector<RuleUse>> all = usesIn(world, *findFramedRule(program, "Post"), box);
  REQUIRE(all);
  CHECK(all->size() == 3);
  const Result<std::vector<RuleUse>> last = usesIn(world, *findFramedRule(program, "Row/Post[2]"), box);
  REQUIRE(last);
  REQUIRE(last->size() == 1);
  CHECK((*last)[0].path == "rows(0, 0, 0)/Row/Post[2]");
  const IntBox& bounds = (*last)[0].bounds;
  CHECK(bounds.contains(Int3{24 * 1024, 2048, 16 * 1024}));
  CHECK(bounds.hi.y >= 4 * 1024);
  const Result<FrameRegion> around = regionAround(world, *findFramedRule(program, "Row/Post[2]"));
  REQUIRE(around);
  CHECK(around->region.lo.y < -4096);
  CHECK(around->cell <= 512);
  const Result<FrameRegion> none = regionAround(world, *findFramedRule(program, "Nothing"));
  REQUIRE_FALSE(none);
  CHECK(none.error().message.find("is not used within 512 m") != std::string::npos);
}

TEST_CASE("the camera shows what is asked for, two thirds of the picture large", "[frame]") {
  const glm::vec3 centre{3, 2, -1};
  const TestMesh ball = sphereMesh(centre, 2, false);
  const std::vector<FrameTarget> targets{targetOf(ball, centre, 2)};
  RenderCamera request;
  request.width = 300;
  request.height = 200;
  request.fov_degrees = 50;
  const auto view = frame(ball, targets, request, [](glm::vec3) { return true; });
  REQUIRE(view);
  CHECK(view->camera.target == centre);
  CHECK(view->seen == 1);
  CHECK(view->fill == Approx(kFrameFill));
  const float distance = glm::distance(view->camera.position, centre);
  CHECK(2 / distance < std::tan(glm::radians(25.0f)));
  CHECK(2 / distance > 0.4f * std::tan(glm::radians(25.0f)));
  const auto again = frame(ball, targets, request, [](glm::vec3) { return true; });
  CHECK(again->camera.position == view->camera.position);
  // If no place is allowed for the camera, no view is found.
  CHECK_FALSE(frame(ball, targets, request, [](glm::vec3) { return false; }));
}

TEST_CASE("of two the one that is not hidden is shown, and from the open side", "[frame]") {
  // A ball hidden in a shell, and a second ball outside of the shell.
  const glm::vec3 hidden{0, 0, 0}, free{12, 0, 0};
  TestMesh mesh = sphereMesh(hidden, 1, false);
  const auto in_ball = static_cast<uint32_t>(mesh.indices.size() / 3);
  const TestMesh other = sphereMesh(free, 1, false);
  add(mesh, other);
  add(mesh, sphereMesh(hidden, 1.5f, false));
  std::vector<FrameTarget> targets{targetOf(sphereMesh(hidden, 1, false), hidden, 1),
                                   targetOf(other, free, 1, in_ball)};
  RenderCamera request;
  const auto view = frame(mesh, targets, request, [](glm::vec3) { return true; });
  REQUIRE(view);
  CHECK(view->target == 1);
  const auto west = frame(mesh, targets, request, [](glm::vec3 p) { return p.x < 11; });
  REQUIRE(west);
  CHECK(west->camera.position.x < 11);
}
