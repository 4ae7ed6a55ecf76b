// The program whose instructions instructions.sh counts. It meshes one chunk of a fixed field on a single thread, one
// pipeline stage per run.
//
//   sgm_bench_instructions --list            prints the names of the pieces of work
//   sgm_bench_instructions PATH WORK         does one piece; PATH is the evaluator: scalar, sse4.2, avx2, avx512

#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "api/grid_mesh.h"
#include "backend/cpu/mesh_chunk.h"
#include "field/compile.h"
#include "field/prune.h"

namespace {

using namespace sgm;

constexpr int32_t kCell = 256;  // edge of a grid cell in units (1/1024 m)

// Makes a field with forty leaf shapes of several kinds: a smooth group with noise on it, a sum, and single shapes.
GrammarChunk makeField() {
  GrammarChunk chunk;
  PathKey key{1};
  uint64_t drawn = 0;
  const auto within = [&](int32_t lo, int32_t hi) {
    return lo + static_cast<int32_t>(key.unit(drawn++) * static_cast<double>(hi - lo));
  };
  const auto leaf = [&](ShapeKind kind, int32_t lo, int32_t hi) {
    Shape s;
    s.kind = kind;
    const int32_t r = within(400, 1400);
    s.inner_radius = static_cast<float>(r);
    s.size = {static_cast<float>(r), static_cast<float>(r / 2), static_cast<float>(r), 0, 0, 0};
    s.frame.origin = {within(lo, hi), within(lo, hi), within(lo, hi)};
    chunk.shapes.push_back(s);
    return static_cast<uint32_t>(chunk.shapes.size() - 1);
  };
  const auto join = [&](ShapeKind kind, const std::vector<uint32_t>& children, float amount) {
    Shape s;
    s.kind = kind;
    s.amount = amount;
    s.first_child = static_cast<uint32_t>(chunk.children.size());
    s.child_count = static_cast<uint32_t>(children.size());
    chunk.children.insert(chunk.children.end(), children.begin(), children.end());
    chunk.shapes.push_back(s);
    return static_cast<uint32_t>(chunk.shapes.size() - 1);
  };
  const auto group = [&](uint32_t root, IntBox bounds) {
    chunk.groups.push_back({root, false, bounds, key.child(7, chunk.groups.size())});
  };
  const IntBox all{{-2000, -2000, -2000}, {10200, 10200, 10200}};

  std::vector<uint32_t> smooth, summed;
  for (int i = 0; i < 12; ++i)
    smooth.push_back(leaf(i % 3 ? ShapeKind::sphere : i % 2 ? ShapeKind::box : ShapeKind::cylinder, 800, 5000));
  for (int i = 0; i < 12; ++i) summed.push_back(leaf(ShapeKind::sphere, 4500, 7400));
  const uint32_t blended = join(ShapeKind::unite_smooth, smooth, 500.0f);
  const uint32_t displaced = join(ShapeKind::displace, {blended}, 0.0f);
  chunk.noises.push_back({{100, 200, 300}, 2048, 3, 5});
  Expr noise, scale, product;
  noise.op = ExprOp::noise;
  noise.noise = 0;
  scale.op = ExprOp::constant;
  scale.value = 0.25f;
  product.op = ExprOp::multiply;
  product.a = 0;
  product.b = 1;
  chunk.exprs.assign({noise, scale, product});
  chunk.shapes[displaced].expr = 2;
  group(displaced, all);
  group(join(ShapeKind::sum, summed, 0.0f), all);
  for (int i = 0; i < 16; ++i) {
    const uint32_t one = leaf(i % 2 ? ShapeKind::torus : ShapeKind::sphere, 500, 7600);
    const Int3 c = chunk.shapes[one].frame.origin;
    group(one, IntBox{c, c}.grown(2200));
  }
  return chunk;
}

/// A job system without threads: each job runs at once on the calling thread.
struct Alone final : JobSystem {
  unsigned concurrency() const override { return 1; }
  void submit(void (*function)(void*), void* argument, int) override { function(argument); }
  bool help() override { return false; }
};

struct Work {
  const FieldKernels* kernels = nullptr;
  const MeshKernels* mesh_kernels = nullptr;
  GrammarChunk chunk = makeField();
  FieldProgram program;
  std::vector<int32_t> x, y, z;
  ChunkSamples samples;
  ChunkGrid grid{{0, 0, 0}, kCell, 0};
  MeshPart part;
  EvalScratch eval;
  PruneScratch pruning;
  PrunedProgram pruned;
  ChunkScratch scratch{std::pmr::get_default_resource()};
  uint64_t kept = 0;
  size_t grid_triangles = 0;

  bool compile() {
    const GroupIndex index(chunk);
    const IndexedCell cell{&chunk, &index};
    const int32_t edge = kChunkCells * kCell;
    FieldSettings settings;
    settings.finest_cell = settings.cell = kCell;
    Result<FieldProgram> made = compileField({&cell, 1}, {{0, 0, 0}, {edge, edge, edge}}, settings);
    if (!made) return false;
    program = std::move(*made);
    return true;
  }
  void places() {
    for (int32_t k = 0; k < kChunkSamples; ++k)
      for (int32_t j = 0; j < kChunkSamples; ++j)
        for (int32_t i = 0; i < kChunkSamples; ++i) {
          x.push_back(i * kCell);
          y.push_back(j * kCell);
          z.push_back(k * kCell);
        }
  }
  Points points(size_t count) const { return {x.data(), y.data(), z.data(), count}; }
  void pruneBricks() {
    constexpr int32_t brick = 8 * kCell, count = kChunkCells / 8;
    for (int32_t k = 0; k < count; ++k)
      for (int32_t j = 0; j < count; ++j)
        for (int32_t i = 0; i < count; ++i) {
          const Int3 lo{i * brick, j * brick, k * brick};
          prune(program.view(), {lo, {lo.x + brick, lo.y + brick, lo.z + brick}}, pruning, pruned);
          kept += pruned.instrs.size();
        }
  }
  void sample() { kernels->samples(program.view(), points(x.size()), eval, samples.q.data()); }
  void signs() {
    for (size_t row = 0; row < samples.signs.size(); ++row) {
      samples.signs[row] = 0;
      for (size_t i = 0; i < kChunkSamples; ++i)
        samples.signs[row] |= uint64_t{samples.q[row * kChunkSamples + i] < 0} << i;
    }
  }
  void attributes() {
    constexpr size_t count = 2048;
    static_assert(count < size_t{kChunkSamples} * kChunkSamples * kChunkSamples);
    normals_x.resize(count);
    normals_y.resize(count);
    labels.resize(count);
    Attributes out;
    out.normal_x = normals_x.data();
    out.normal_y = normals_y.data();
    out.label = labels.data();
    kernels->attributes(program.view(), points(count), eval, out);
  }
  void mesh() {
    mesh_kernels->polygonize(samples, grid, true, scratch.mesh, part);
    mesh_kernels->hash(part);
  }
  /// Makes the complete mesh of a chunk from a compiled program, as a backend does.
  void meshWhole() {
    ChunkJob job;
    job.grid = grid;
    job.field = std::make_shared<const FieldProgram>(program);
    ChunkMesh made;
    meshChunk({*kernels, *mesh_kernels}, job, scratch, made);
    part = std::move(made.body);
  }
  /// Meshes a grid of float samples that a caller provides, with normals.
  void meshGrid() {
    constexpr size_t side = kChunkSamples;
    std::vector<float> values(samples.q.size());
    for (size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(samples.q[i]) / 1024;
    Alone jobs;
    const auto made = api::meshGrid({values.data(), {side, side, side}, side, side * side, 1, true}, jobs,
                                    std::pmr::get_default_resource(), *mesh_kernels);
    grid_triangles = made ? made->indices.size() / 3 : 0;
  }

 private:
  std::vector<int16_t> normals_x, normals_y;
  std::vector<uint32_t> labels;
};

using Piece = std::function<void(Work&)>;

const std::map<std::string, Piece> kWork = {
    {"prune", [](Work& w) { w.pruneBricks(); }},     {"samples", [](Work& w) { w.sample(); }},
    {"attributes", [](Work& w) { w.attributes(); }}, {"mesh", [](Work& w) { w.mesh(); }},
    {"chunk", [](Work& w) { w.meshWhole(); }},       {"grid", [](Work& w) { w.meshGrid(); }},
};

}  // namespace

// Runs one piece of work. Valgrind counts the instructions within the function of this name, so it must not be inlined.
extern "C" __attribute__((noinline)) void measured(const Piece& piece, Work& on) { piece(on); }

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "--list") {
    for (const auto& [name, work] : kWork) std::printf("%s\n", name.c_str());
    return 0;
  }
  if (argc != 3 || !kWork.count(argv[2])) {
    std::fprintf(stderr, "usage: sgm_bench_instructions --list | PATH WORK\n");
    return 2;
  }
  Work work;
  work.kernels = findKernels(argv[1]);
  work.mesh_kernels = findMeshKernels(argv[1]);
  if (!work.kernels || !work.mesh_kernels) {
    std::fprintf(stderr, "no evaluator is called %s here\n", argv[1]);
    return 1;
  }
  work.places();
  if (!work.compile()) {
    std::fprintf(stderr, "the field does not compile\n");
    return 1;
  }
  work.sample();
  work.signs();
  const auto& piece = kWork.at(argv[2]);
  piece(work);  // this first run is not counted: it lets buffers grow to their size
  measured(piece, work);
  std::printf("%zu vertices, %zu triangles, %zu of a grid, %llu instructions kept\n", work.part.vertices.size(),
              work.part.indices.size() / 3, work.grid_triangles, static_cast<unsigned long long>(work.kept));
  return 0;
}
