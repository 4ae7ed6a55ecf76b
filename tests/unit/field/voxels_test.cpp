// Tests blocks of voxels as a field: values are close to the definition in voxels.h, each voxel's centre is on the
// right side of the surface, and several pieces give the same bits as one.

#include "field/voxels.h"
#include "seed.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "catch.h"
#include "derive/bounds.h"
#include "field/compile.h"
#include "field/evaluate.h"
#include "rounds.h"

using namespace sgm;

namespace {

int32_t between(std::mt19937& random, int32_t low, int32_t high) {
  return std::uniform_int_distribution<int32_t>(low, high)(random);
}

/// A world of voxels. A function of a voxel's indices decides whether the voxel is solid; it makes random clumps here.
struct VoxelWorld {
  uint64_t seed = 0;
  int32_t edge = 1024;
  Int3 anchor;
  bool flat = false;

  bool solid(Int3 i) const {
    if (flat) i.y = 0;
    const auto draw = [&](Int3 p, uint64_t salt) {
      uint64_t h = hashCombine(seed, salt);
      for (int axis = 0; axis < 3; ++axis) h = hashCombine(h, static_cast<uint32_t>(p[axis]));
      return PathKey{h}.unit(0);
    };
    const Int3 clump{i.x >> 2, i.y >> 2, i.z >> 2};
    return draw(i, 1) + 2 * draw(clump, 2) < 1.4;
  }
};

/// The part of the world in one grammar cell, as derivation would return it.
GrammarChunk pieceOf(const VoxelWorld& world, Int3 cell, int32_t cell_edge, int32_t height = 1 << 18) {
  GrammarChunk chunk;
  chunk.cell = cell;
  VoxelBlock block;
  block.edge = world.edge;
  block.anchor = world.anchor;
  Shape shape;
  shape.kind = ShapeKind::voxels;
  shape.block = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    if (world.flat && axis == 1) {
      shape.size[a] = 4e9f;
      continue;
    }
    const int64_t low = int64_t{cell[axis]} * cell_edge;
    block.first[axis] = static_cast<int32_t>(floorDiv(low, world.edge)) - kVoxelMargin;
    const auto last = static_cast<int32_t>(floorDiv(low + cell_edge - 1, world.edge)) + 1 + kVoxelMargin;
    block.count[axis] = last - block.first[axis] + 1;
    shape.frame.origin[axis] = static_cast<int32_t>(low) + cell_edge / 2 + world.anchor[axis];
    shape.size[a] = static_cast<float>((cell_edge + 1) / 2 + world.edge);
  }
  chunk.voxels.resize(block.words());
  size_t bit = 0;
  for (int32_t z = 0; z < std::max(block.count.z, 1); ++z)
    for (int32_t y = 0; y < std::max(block.count.y, 1); ++y)
      for (int32_t x = 0; x < std::max(block.count.x, 1); ++x, ++bit)
        chunk.voxels[bit / 64] |= uint64_t{world.solid(saturatingAdd(block.first, {x, y, z}))} << (bit % 64);
  chunk.blocks.push_back(block);
  chunk.shapes.push_back(shape);
  IntBox bounds = levelBounds(chunk, 0, 0);
  if (world.flat) bounds.lo.y = -height, bounds.hi.y = height;
  chunk.groups.push_back({0, false, bounds, {}});
  return chunk;
}

struct Values {
  std::vector<float> value, x, y, z;
};

Values valuesOf(const std::vector<GrammarChunk>& chunks, const std::vector<Int3>& places, int32_t cell) {
  std::vector<GroupIndex> indices;
  for (const GrammarChunk& c : chunks) indices.emplace_back(c);
  std::vector<IndexedCell> cells;
  for (size_t i = 0; i < chunks.size(); ++i) cells.push_back({&chunks[i], &indices[i]});
  IntBox box;
  std::vector<int32_t> x, y, z;
  for (const Int3 p : places) {
    box = box.joined({p, p});
    x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  }
  FieldSettings settings;
  settings.cell = cell;
  const Result<FieldProgram> program = compileField(cells, box, settings);
  REQUIRE(program);
  const size_t n = places.size();
  Values v{std::vector<float>(n), std::vector<float>(n), std::vector<float>(n), std::vector<float>(n)};
  std::vector<uint32_t> label(n);
  EvalScratch scratch;
  scalarKernels().attributes(program->view(), {x.data(), y.data(), z.data(), n}, scratch,
                             {v.value.data(), v.x.data(), v.y.data(), v.z.data(), nullptr, nullptr, label.data()});
  return v;
}

/// The definition in voxels.h, in double precision without rounding.
class Expected {
 public:
  Expected(const VoxelWorld& world, int32_t cell) : world_(world) {
    step_ = cell >= 4 * world.edge ? 4 : cell >= 2 * world.edge ? 2 : 1;
    tent_ = step_ == 4 ? 4 : 2;
  }

  double at(Int3 p) const {
    std::array<int64_t, 3> low{};
    std::array<double, 3> part{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<size_t>(axis);
      const int64_t spacing = int64_t{world_.edge} * step_, offset = int64_t{p[axis]} - world_.anchor[axis];
      low[a] = floorDiv(offset, spacing);
      part[a] = static_cast<double>(offset - low[a] * spacing) / static_cast<double>(spacing);
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      Int3 index;
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<size_t>(axis);
        const int high = corner >> axis & 1;
        weight *= high != 0 ? part[a] : 1 - part[a];
        index[axis] = static_cast<int32_t>((low[a] + high) * step_);
      }
      if (weight > 0) sum += weight * sample(index);
    }
    return sum;
  }

 private:
  double sample(Int3 index) const {
    double solid = 0, all = 0;
    for (int z = 1 - tent_; z < tent_; ++z)
      for (int y = 1 - tent_; y < tent_; ++y)
        for (int x = 1 - tent_; x < tent_; ++x) {
          const double weight = (tent_ - std::abs(x)) * (tent_ - std::abs(y)) * (tent_ - std::abs(z));
          all += weight;
          if (world_.solid(saturatingAdd(index, {x, y, z}))) solid += weight;
        }
    const double edge = world_.edge, value = (0.5 - solid / all) * tent_ * edge;
    const double held = std::clamp(value, -edge * 7 / 8, edge * 7 / 8);
    if (tent_ == 4) return held;
    return world_.solid(index) ? std::min(held, -edge / 4) : std::max(held, edge / 4);
  }

  const VoxelWorld& world_;
  int step_ = 1, tent_ = 2;
};

VoxelWorld anyWorld(std::mt19937& random) {
  VoxelWorld world;
  world.seed = random();
  world.edge = between(random, 0, 1) == 0 ? 1024 : between(random, 16, 3000);
  if (between(random, 0, 1) == 0) world.anchor = {between(random, -1 << 28, 1 << 28), 77, -12345};
  world.flat = between(random, 0, 3) == 0;
  return world;
}

}  // namespace

TEST_CASE("voxels are as smooth as is said, at every level") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(12); ++round) {
    const VoxelWorld world = anyWorld(random);
    const int32_t cell_edge = 12 * world.edge, cell = world.edge * between(random, 1, 8) / 2;
    CAPTURE(round, world.edge, cell, world.flat);
    const GrammarChunk piece = pieceOf(world, {}, cell_edge);
    std::vector<Int3> places;
    for (int i = 0; i < 300; ++i) {
      Int3 p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = world.anchor[axis] + between(random, 0, cell_edge);
      if (i % 3 == 0) {
        // Every third place is the exact lattice position of a voxel.
        for (int axis = 0; axis < 3; ++axis) p[axis] = world.anchor[axis] + between(random, 0, 12) * world.edge;
      }
      places.push_back(p);
    }
    const Values found = valuesOf({piece}, places, cell);
    const Expected expected(world, cell);
    for (size_t i = 0; i < places.size(); ++i) {
      const double wanted = expected.at(places[i]);
      CAPTURE(i, places[i].x, places[i].y, places[i].z);
      // The tolerance covers rounding: samples are rounded to whole units, also those that are limited to 7/8 or 1/4 of
      // a voxel's edge.
      CHECK(std::abs(static_cast<double>(found.value[i]) - wanted) < 2.01);
      if (i % 3 == 0 && cell < 2 * world.edge) {
        const Int3 off = saturatingSub(places[i], world.anchor);
        const bool solid = world.solid({off.x / world.edge, off.y / world.edge, off.z / world.edge});
        CHECK((found.value[i] < 0) == solid);
      }
    }
  }
}

TEST_CASE("voxels in pieces are the same as in one, to the bit, at every level") {
  const unsigned seed = testSeed();
  CAPTURE(seed);
  std::mt19937 random(seed);
  for (unsigned round = 0; round < rounds(12); ++round) {
    const VoxelWorld world = anyWorld(random);
    // Eight pieces, two along each axis, and one piece that contains all of them. The sizes of the pieces need not be
    // whole numbers of voxels.
    const int32_t small = between(random, 3 * world.edge, 9 * world.edge),
                  cell = world.edge * between(random, 1, 8) / 2;
    const Int3 home{between(random, -3, 3), 0, between(random, -3, 3)};
    CAPTURE(round, world.edge, small, cell, home.x, home.z, world.flat);
    std::vector<GrammarChunk> pieces, whole;
    for (int32_t k = 0; k < 8; ++k) {
      if (world.flat && (k >> 1 & 1) != 0) continue;
      pieces.push_back(
          pieceOf(world, saturatingAdd({2 * home.x, 2 * home.y, 2 * home.z}, {k & 1, k >> 1 & 1, k >> 2}), small));
    }
    whole.push_back(pieceOf(world, home, 2 * small));
    std::vector<Int3> places;
    for (int i = 0; i < 2000; ++i) {
      Int3 p;
      for (int axis = 0; axis < 3; ++axis) {
        const int32_t low = world.anchor[axis] + 2 * small * home[axis];
        // Half of the points lie near the faces between the pieces.
        p[axis] =
            low + (i % 2 == 0 ? between(random, 0, 2 * small - 1) : small + between(random, -world.edge, world.edge));
      }
      places.push_back(p);
    }
    const Values a = valuesOf(pieces, places, cell), b = valuesOf(whole, places, cell);
    const auto same = [](const std::vector<float>& u, const std::vector<float>& v) {
      return std::memcmp(u.data(), v.data(), u.size() * sizeof(float)) == 0;
    };
    CHECK(same(a.value, b.value));
    CHECK(same(a.x, b.x));
    CHECK(same(a.y, b.y));
    CHECK(same(a.z, b.z));
  }
}

TEST_CASE("coarse levels leave voxels out") {
  const VoxelWorld world{3, 512, {}, false};
  const GrammarChunk piece = pieceOf(world, {}, 8 * 512);
  const std::vector<Int3> place{{2048, 2048, 2048}};
  CHECK(std::abs(valuesOf({piece}, place, 4 * 512).value[0]) < 512);
  CHECK(valuesOf({piece}, place, 4 * 512 + 1).value[0] == kFar);
}

TEST_CASE("a warp reads voxels wherever it leads") {
  const VoxelWorld world{4, 1024, {}, false};
  GrammarChunk piece = pieceOf(world, {}, 12 * 1024);
  Expr by;
  by.value = 2;
  Expr none;
  piece.exprs = {by, none, none};
  Shape warp;
  warp.kind = ShapeKind::warp;
  warp.expr = 0;
  warp.child_count = 1;
  piece.children = {0};
  piece.shapes.push_back(warp);
  piece.groups[0] = {1, false, levelBounds(piece, 1, 0), {}};
  const GrammarChunk plain = pieceOf(world, {}, 12 * 1024);
  std::mt19937 random(5);
  for (int i = 0; i < 50; ++i) {
    const Int3 p{between(random, 0, 9 * 1024), between(random, 0, 11 * 1024), between(random, 0, 11 * 1024)};
    CHECK(valuesOf({piece}, {p}, 512).value[0] == valuesOf({plain}, {{p.x + 2048, p.y, p.z}}, 512).value[0]);
  }
}

TEST_CASE("below a warp, what few places read is what many do") {
  const VoxelWorld world{4, 1024, {}, false};
  GrammarChunk piece = pieceOf(world, {}, 24 * 1024);
  // A displacement of (1.7 n, -0.9 n, n * x) metres, where n is noise from -1 to 1, and x depends on the position.
  Expr n, amount, less, x;
  n.op = ExprOp::noise, n.noise = 0;
  amount.value = 1.7f, less.value = -0.9f;
  x.op = ExprOp::coordinate, x.row = {0.5f, 0, 0};
  const auto product = [](uint32_t a, uint32_t b) {
    Expr e;
    e.op = ExprOp::multiply, e.a = a, e.b = b;
    return e;
  };
  piece.exprs = {n, amount, less, x, product(0, 1), product(0, 2), product(0, 3)};
  NoiseSpec noise;
  noise.period = 3 * 1024, noise.octaves = 2, noise.seed = 9;
  piece.noises = {noise};
  Shape warp;
  warp.kind = ShapeKind::warp;
  warp.expr = 4;
  warp.child_count = 1;
  piece.children = {0};
  piece.shapes.push_back(warp);
  piece.groups[0] = {1, false, levelBounds(piece, 0, 0).grown(16 * 1024), {}};
  std::mt19937 random(8);
  std::vector<Int3> places;
  for (int i = 0; i < 300; ++i)
    places.push_back({between(random, 0, 20 * 1024), between(random, 0, 20 * 1024), between(random, 0, 20 * 1024)});
  const Values together = valuesOf({piece}, places, 512);
  size_t solid = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    CAPTURE(i);
    const Values alone = valuesOf({piece}, {places[i]}, 512);
    CHECK(alone.value[0] == together.value[i]);
    CHECK(alone.x[0] == together.x[i]);
    solid += together.value[i] < 0;
  }
  CHECK(solid > 30);
  CHECK(solid < 270);
}
