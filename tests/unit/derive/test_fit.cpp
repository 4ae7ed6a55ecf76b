// Tests assets in scopes: their places, their materials, and the notes about assets that do not fit.

#include <algorithm>
#include <map>
#include <set>

#include "../asset/bodies.h"
#include "../asset/glb_bytes.h"
#include "../grammar/compile_text.h"
#include "derive/bounds.h"
#include "derive_fixture.h"

using namespace sgm;

namespace {

std::shared_ptr<const Program> withAssets(const std::string& rules) {
  test::MapResolver files;
  files.files["bay.glb"] = asset::glbOf(asset::archedBay(6));
  files.files["house.glb"] = asset::glbOf(asset::gabledHouse());
  const CompileResult result = test::compileText(
      "sgm 1; import \"bay.glb\" as bay; import \"house.glb\" as house; domain infinite; layer main cell 64m reach 64m "
      "{ "
      "start Main; }\n" +
          rules,
      &files);
  INFO(renderDiagnostics(result));
  REQUIRE(result.program);
  return result.program;
}

GrammarChunk fitted(const std::string& statement) {
  const auto program = withAssets("rule Main { at(20m, 20m, 20m) { " + statement + " } }");
  return derived(*program);
}

std::string noteOf(const std::string& statement) {
  const GrammarChunk chunk = fitted("sphere(1m); " + statement);
  REQUIRE(chunk.groups.size() == 1);  // only the faulty statement is left out
  REQUIRE(chunk.notes.size() == 1);
  CHECK(chunk.notes[0].path == "main(0, 0, 0)/Main");
  CHECK(chunk.notes[0].line == 2);
  return chunk.notes[0].message;
}

}  // namespace

TEST_CASE("a fitted asset fills its scope's box and no more", "[derive][fit]") {
  for (const char* turn : {"", "rot(y, 90deg) ", "mirror(x) ", "scale(2) size(3m, 2m, 4m) "}) {
    const GrammarChunk chunk = fitted("size(6m, 4m, 8m) " + std::string(turn) + "fit house;");
    REQUIRE(chunk.groups.size() == 1);
    const IntBox box = chunk.groups[0].bounds;
    const bool turned = std::string(turn).starts_with("rot");
    const double half[3] = {turned ? 4.0 : 3.0, 2.0, turned ? 3.0 : 4.0};
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(box.lo[axis] == Approx((20 - half[axis]) * 1024).margin(8));
      CHECK(box.hi[axis] == Approx((20 + half[axis]) * 1024).margin(8));
    }
  }
}

TEST_CASE("the planes of a fitted asset lie where they are to the tenth of a unit, however it is turned",
          "[derive][fit]") {
  const auto program =
      withAssets("rule Main { at(20.3m, 20.7m, 20.1m) rot((1, 2, 3), 33deg) size(9m, 7m, 11m) fit house; }");
  const GrammarChunk chunk = derived(*program);
  // Opposite planes of the asset are as far apart as the scope is long on that axis.
  std::vector<double> distances;
  for (size_t i = 0; i < chunk.shapes.size(); ++i)
    for (size_t k = i + 1; k < chunk.shapes.size(); ++k) {
      const Shape &a = chunk.shapes[i], &b = chunk.shapes[k];
      if (a.kind != ShapeKind::halfspace || b.kind != ShapeKind::halfspace) continue;
      double facing = 0, apart = 0;
      for (size_t axis = 0; axis < 3; ++axis) {
        facing += double{a.frame.rows[3 + axis]} * double{b.frame.rows[3 + axis]};
        apart += double{a.frame.rows[3 + axis]} *
                 (a.frame.origin[static_cast<int>(axis)] - b.frame.origin[static_cast<int>(axis)]);
      }
      if (facing < -0.9999) distances.push_back(std::fabs(apart) / 1024);
    }
  std::sort(distances.begin(), distances.end());
  REQUIRE(distances.size() == 2);  // two pairs of walls; the floor is not parallel to the roof
  CHECK(distances[0] == Approx(9).margin(0.0002));
  CHECK(distances[1] == Approx(11).margin(0.0002));
}

TEST_CASE("faces have the asset's materials, but for an override's and for those without one", "[derive][fit]") {
  const auto materialsOf = [](const std::string& rules) {
    const auto program = withAssets(rules);
    const GrammarChunk chunk = derived(*program);
    std::set<std::string> out;
    for (const Shape& shape : chunk.shapes)
      if (shape.kind == ShapeKind::halfspace) out.emplace(program->materials[shape.material]);
    return out;
  };
  const std::string house =
      "rule Main { House; } rule House { at(20m, 9m, 9m) size(6m, 6m, 8m) fit house; mat clay; tag \"h\"; }";
  CHECK(materialsOf(house) == std::set<std::string>{"plaster", "slate"});
  CHECK(materialsOf("rule Main { at(20m, 9m, 9m) size(6m, 6m, 8m) fit bay; mat clay; }") ==
        std::set<std::string>{"clay"});
  CHECK(materialsOf(house + "override \"Main/House\" { inner; mat ice; }") == std::set<std::string>{"ice"});
  CHECK(materialsOf(house + "override tag \"h\" { inner; mat ice; }") == std::set<std::string>{"ice"});
}

TEST_CASE("pieces that lie behind one face share its half-space", "[derive][fit]") {
  const GrammarChunk chunk = fitted("size(21m, 5m, 1m) fit bay repeat x 0.25m..2.75m;");
  std::set<std::pair<std::array<int32_t, 3>, std::array<float, 9>>> frames;
  size_t planes = 0;
  for (const Shape& shape : chunk.shapes) {
    if (shape.kind != ShapeKind::halfspace) continue;
    ++planes;
    frames.insert({{shape.frame.origin.x, shape.frame.origin.y, shape.frame.origin.z}, shape.frame.rows});
  }
  CHECK(frames.size() == planes);
  CHECK(planes >= 8 * 6);
}

TEST_CASE("an asset that does not fit is left out with a note, and the rest appears", "[derive][fit]") {
  CHECK(noteOf("size(14m, 3m, 8m) fit house;") ==
        "impossible fit: with its angles kept, and stiff where it has no zone to stretch, this asset cannot be 14m x "
        "3m x "
        "8m; it could be at most 8.879m along x, or at least 4.707m along y; it is left out");
  CHECK(noteOf("size(6m, 6m, 8m) fit house stretch x 4m..9m;") ==
        "the zone 4m..9m along x is not a part of this asset, which goes from 0m to 6m there; it is left out");
  CHECK(noteOf("size(6m, 0m, 8m) fit house;") ==
        "this scope has no size along y, so nothing fits into it: give it one, such as size(y 3m)");
}

TEST_CASE("an asset that would run through itself is left out with a note", "[derive][fit]") {
  // A gable roof that cuts into the window if it is lowered, because the window keeps its height.
  asset::MeshMaker maker;
  maker.prism({{0, 0}, {6, 0}, {6, 4}, {3, 7}, {0, 4}}, 0, 2);
  asset::MeshMaker window;
  window.box({4.6, 3.4, -1}, {5.4, 3.9, 3});
  test::MapResolver files;
  for (auto& t : window.mesh.triangles) {
    std::swap(t[1], t[2]);
    for (uint32_t& corner : t) corner += static_cast<uint32_t>(maker.mesh.points.size());
  }
  maker.mesh.points.insert(maker.mesh.points.end(), window.mesh.points.begin(), window.mesh.points.end());
  maker.mesh.triangles.insert(maker.mesh.triangles.end(), window.mesh.triangles.begin(), window.mesh.triangles.end());
  maker.mesh.materials.resize(maker.mesh.triangles.size(), asset::kNoMaterial);
  files.files["a.glb"] = asset::glbOf(maker.mesh);
  const CompileResult result = test::compileText(
      "sgm 1; import \"a.glb\" as a; start A; rule A { sphere(1m); size(6m, 7m, 4m) fit a; }", &files);
  REQUIRE(result.program);
  const GrammarChunk chunk = derived(*result.program);
  REQUIRE(chunk.notes.size() == 1);
  CHECK(chunk.notes[0].message == "in this size it intersects itself; it is left out");
}

TEST_CASE("the same asset in the same size is fitted once, and costs steps", "[derive][fit]") {
  const auto program = withAssets("rule Main { repeat 300 at(0.1m, 0m, 0m) size(6m, 6m, 8m) fit house; }");
  const auto parameters = ParameterValues::defaults(*program);
  const Ceiling below(1 << 30);
  CHECK(deriveCell(*program, parameters, 7, 0, {}, below, {.steps = 20'000}));
  const auto stopped = deriveCell(*program, parameters, 7, 0, {}, below, {.steps = 1'000});
  REQUIRE_FALSE(stopped);
  CHECK(stopped.error().code == Code::limit);
}
