// Tests normals and vertices against the field: for known shapes, for decreasing cell sizes, and with deliberate
// faults.

#include "region/field_agreement.h"

#include <cmath>
#include <cstdlib>
#include <random>

#include "field/reference.h"
#include "mesh/split_creases.h"
#include "mesh/vertex.h"
#include "meshed_world.h"

using namespace sgm;
using namespace sgm::test;

namespace {

FieldAgreement agreementOf(const MeshedWorld& world, const WorldMesh& mesh, int level = 0) {
  const Result<FieldAgreement> result = fieldAgreement(world.field(), world.jobs(), mesh, level);
  INFO((result ? "" : result.error().message));
  REQUIRE(result);
  return *result;
}

FieldAgreement agreementOf(const std::string& shapes, double cell) {
  const World world("sgm 1; start A; rule A { " + shapes + " }");
  const MeshedWorld meshed(world, cell);
  return agreementOf(meshed, meshed.meshed().mesh);
}

/// Reverses a vertex's normal, given by its octahedral code.
void turn(VertexAttributes& vertex) {
  const auto folded = [](int x, int other) { return (32767 - std::abs(other)) * (x < 0 ? 1 : -1); };
  const int x = vertex.normal_x, y = vertex.normal_y;
  vertex.normal_x = static_cast<int16_t>(folded(x, y));
  vertex.normal_y = static_cast<int16_t>(folded(y, x));
}

/// Moves each vertex to its exact place, before the rounding by packing: the zero of a linear function between the
/// field's values at both ends of the vertex's edge.
void placeExactly(const MeshedWorld& world, WorldMesh& mesh) {
  const int32_t cell = world.field().cellAt(0);
  const Result<std::shared_ptr<const FieldProgram>> field = world.field().compile(IntBox::everything(), 0);
  REQUIRE(field);
  for (size_t v = 0; v < mesh.keys.size(); ++v) {
    const VertexKey& key = mesh.keys[v];
    Int3 end = key.corner;
    end[key.axis] += cell;
    const double low = referenceField((*field)->view(), key.corner), high = referenceField((*field)->view(), end);
    for (int axis = 0; axis < 3; ++axis) {
      mesh.positions[v][static_cast<size_t>(axis)] = metres(key.corner[axis]) - metres(mesh.origin[axis]);
    }
    mesh.positions[v][key.axis] += metres(cell) * low / (low - high);
  }
}

/// The order of convergence: the exponent p for which the errors are proportional to (cell size)^p, by least squares.
/// errors: those of a sequence of cell sizes, each half of the previous one.
double orderOfErrors(const std::vector<double>& errors) {
  double sum = 0, weights = 0;
  const double middle = 0.5 * static_cast<double>(errors.size() - 1);
  for (size_t i = 0; i < errors.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    sum -= x * std::log2(errors[i]);
    weights += x * x;
  }
  return sum / weights;
}

}  // namespace

TEST_CASE("normals are the gradient, and vertices lie on the surface") {
  for (const char* shapes : {"sphere(5m);", "torus(5m, 2m);", "rot(x, 20deg) torus(5m, 2m);", "ellipsoid(6m, 4m, 5m);",
                             "union smooth 2m { sphere(4m); at(5m, 1m, 0) sphere(3m); }"}) {
    const FieldAgreement found = agreementOf(shapes, 0.125);
    CAPTURE(shapes, found.normals.p99, found.normals.greatest, found.faces.p99, found.residual_max);
    CHECK(found.step == 16);
    CHECK(found.vertices > 10'000);
    CHECK(found.flat == 0);
    CHECK(found.bent == 0);
    CHECK(found.normals.count == found.vertices);
    CHECK(found.normals.inward == 0);
    CHECK(found.normals.outward() == 1);
    // Normals are allowed to deviate by 5 degrees, but are much better: packing costs 0.004 degrees, and rounding to
    // 1/2048 m at a radius of 2 m and central differences over 8 units cost little more.
    CHECK(found.normals.greatest < 0.1);
    CHECK(found.normals.p99 <= found.normals.greatest);
    CHECK(found.normals.median <= found.normals.p99);
    CHECK(found.faces.inward == 0);
    // Triangles may deviate from the field's normal by the angle that a cell's diagonal spans: 6.2 degrees at the
    // smallest radius, 2 m.
    CHECK(found.faces.p99 < 6.2);
    // The expected error is the sum of the sagitta, h^2 / (8 r), and of the rounding of positions, 1/512 of a cell.
    CHECK(found.residual_max * metres(1) < 0.125 * 0.125 / 8 / 1.5 + 0.125 / 512 + 1e-4);
    CHECK(found.residual_mean <= found.residual_p99);
    CHECK(found.residual_p99 <= found.residual_max);
  }
}

TEST_CASE("normals of triangles converge with the cell, and vertices with its square", "[costly]") {
  for (const char* shape : {"sphere(20m);", "torus(20m, 10m);"}) {
    std::vector<double> normals, residuals, means;
    for (const double cell : {4.0, 2.0, 1.0, 0.5, 0.25}) {
      const World world("sgm 1; start A; rule A { " + std::string(shape) + " }");
      const MeshedWorld meshed(world, cell);
      WorldMesh mesh = meshed.meshed().mesh;
      const double as_packed = agreementOf(meshed, mesh).residual_max;
      placeExactly(meshed, mesh);
      const FieldAgreement found = agreementOf(meshed, mesh);
      normals.push_back(found.faces.median);
      residuals.push_back(found.residual_max);
      means.push_back(found.residual_mean);
      // Packed vertices are rounded to 1/256 of their edge, and never to its ends.
      CHECK(as_packed < found.residual_max + cell * kUnitsPerMetre / 256 + 0.01);
    }
    CAPTURE(shape, normals, residuals, means);
    CHECK(orderOfErrors(normals) >= 0.9);
    CHECK(orderOfErrors(means) >= 1.9);
    // Leave out the first cell size: it is two fifths of the smallest radius, so higher-order terms dominate its
    // largest error.
    residuals.erase(residuals.begin());
    CHECK(orderOfErrors(residuals) >= 1.9);
  }
}

TEST_CASE("normals that are turned are found, each of them") {
  const World world("sgm 1; start A; rule A { sphere(5m); }");
  const MeshedWorld meshed(world, 0.25);
  WorldMesh mesh = meshed.meshed().mesh;
  std::mt19937 random(4);
  size_t turned = 0;
  for (VertexAttributes& vertex : mesh.attributes) {
    if (random() % 100 != 0) continue;
    turn(vertex);
    ++turned;
  }
  REQUIRE(turned > 10);
  const FieldAgreement found = agreementOf(meshed, mesh);
  CHECK(found.normals.inward == turned);
  CHECK(found.normals.outward() == Approx(1 - double(turned) / double(found.vertices)));
  CHECK(found.normals.greatest > 179);
  CHECK(found.faces.inward == 0);
}

TEST_CASE("triangles that are turned are found, each at its three corners") {
  const World world("sgm 1; start A; rule A { sphere(5m); }");
  const MeshedWorld meshed(world, 0.25);
  WorldMesh mesh = meshed.meshed().mesh;
  size_t turned = 0;
  for (size_t i = 0; i < mesh.indices.size(); i += 3 * 50) {
    std::swap(mesh.indices[i], mesh.indices[i + 1]);
    ++turned;
  }
  const FieldAgreement found = agreementOf(meshed, mesh);
  CHECK(found.faces.inward == 3 * turned);
  CHECK(found.normals.inward == 0);
}

TEST_CASE("vertices that are off are found, with how far") {
  const World world("sgm 1; start A; rule A { sphere(5m); }");
  const MeshedWorld meshed(world, 0.25);
  const WorldMesh good = meshed.meshed().mesh;
  const double before = agreementOf(meshed, good).residual_max;
  WorldMesh one = good;
  const size_t at = one.positions.size() / 3;
  one.positions[at][1] += one.positions[at][1] + metres(one.origin.y) > 0 ? 0.5 : -0.5;
  const FieldAgreement spike = agreementOf(meshed, one);
  CHECK(spike.residual_max > 10 * before);
  CHECK(spike.farthest == one.positions[at]);
  CHECK(spike.residual_p99 < 2 * before);
  // Moves the whole mesh up by a tenth of a metre.
  WorldMesh all = good;
  for (std::array<double, 3>& p : all.positions) p[1] += 0.1;
  const FieldAgreement shifted = agreementOf(meshed, all);
  CHECK(shifted.residual_max * metres(1) > 0.095);
  CHECK(shifted.residual_max * metres(1) < 0.105 + before * metres(1));
  CHECK(shifted.normals.greatest > 0.9);  // atan(0.1 / 5) = 1.1 degrees
}

TEST_CASE("where the field is no distance, offsets are one") {
  // An ellipsoid's field grows half as fast along its long axes as along the short one.
  const World world("sgm 1; start A; rule A { ellipsoid(6m, 3m, 6m); }");
  const MeshedWorld meshed(world, 0.25);
  WorldMesh mesh = meshed.meshed().mesh;
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    const std::array<double, 3> normal = unpackNormal(mesh.attributes[v].normal_x, mesh.attributes[v].normal_y);
    for (size_t axis = 0; axis < 3; ++axis) mesh.positions[v][axis] += 0.05 * normal[axis];
  }
  const FieldAgreement found = agreementOf(meshed, mesh);
  CAPTURE(found.offset_mean, found.offset_p99, found.residual_mean);
  CHECK(found.offset_mean == Approx(0.05 * kMetre).epsilon(0.1));
  CHECK(found.offset_p99 < 0.06 * kMetre);
  CHECK(found.residual_mean < 0.9 * found.offset_mean);
  CHECK(found.offset_p99 <= found.offset_max);
}

TEST_CASE("what lies in a crease is counted apart") {
  const World world("sgm 1; start A; rule A { box(8.1m, 6.3m, 7.2m); }");
  const MeshedWorld meshed(world, 0.25);
  const IntBox all = world.program().domain.box;
  const WorldMesh sharp = splitCreases(meshed.meshed(all, 0, true).mesh);
  const FieldAgreement found = agreementOf(meshed, sharp);
  // About 345 cells along the box's twelve edges have one feature vertex inside and one in the face to the next cell;
  // the latter counts once for each side.
  CHECK(found.bent > 4 * 330);
  CHECK(found.bent < 4 * 360);
  CHECK(found.normals.count + found.bent + found.flat == found.vertices);
  CHECK(found.bent_inward == 0);
  CHECK(found.normals.inward == 0);
  CHECK(found.normals.greatest < 0.01);
  CHECK(found.faces.greatest < 2);
}

TEST_CASE("coarse levels and places far out are measured by their own field and cells") {
  const World world(
      "sgm 1; domain infinite; layer l cell 64m reach 16m { start A; } "
      "rule A { at(32m, 32m, 32m) sphere(11m); }");
  const MeshedWorld meshed(world, 0.25);
  for (const double at : {0.0, 1'000'000.0, -1'000'000.0}) {
    for (const int level : {0, 2}) {
      const WorldMesh mesh = meshed.meshed(cube(64 * std::floor(at / 64), 64 * std::floor(at / 64) + 64), level).mesh;
      const FieldAgreement found = agreementOf(meshed, mesh, level);
      CAPTURE(at, level, found.normals.greatest, found.residual_max);
      CHECK(found.step == (level == 0 ? 32 : 128));
      CHECK(found.vertices > 500);
      CHECK(found.normals.inward == 0);
      CHECK(found.normals.greatest < 0.1);
      CHECK(found.residual_max * metres(1) < (level == 0 ? 0.002 : 0.02));
    }
  }
}

TEST_CASE("agreement is the same for any number of threads, and nothing agrees with everything") {
  const World world("sgm 1; start A; rule A { torus(5m, 2m); }");
  const MeshedWorld meshed(world, 0.5);
  const WorldMesh mesh = meshed.meshed().mesh;
  const Result<std::unique_ptr<JobSystem>> one = makeThreadPool(1);
  REQUIRE(one);
  const Result<FieldAgreement> a = fieldAgreement(meshed.field(), **one, mesh, 0);
  REQUIRE(a);
  const FieldAgreement b = agreementOf(meshed, mesh);
  CHECK(a->residual_mean == b.residual_mean);
  CHECK(a->normals.p99 == b.normals.p99);
  CHECK(a->faces.greatest == b.faces.greatest);
  const FieldAgreement none = agreementOf(meshed, WorldMesh());
  CHECK(none.vertices == 0);
  CHECK(none.normals.outward() == 1);
  CHECK(none.residual_max == 0);
}
