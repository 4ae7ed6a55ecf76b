// Compiles field programs from derived cells with arbitrary contents. Contents of any depth and at any place must
// compile or be rejected with an error; pruned programs and all instruction sets must give the same bits.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "backend/cpu/instruction_sets.h"
#include "field/compile.h"
#include "field/prune.h"

namespace {

using namespace sgm;

void require(bool held, const char* what) {
  if (held) return;
  std::fprintf(stderr, "tape_fuzz: %s\n", what);
  std::abort();
}

/// Reads numbers from the fuzzer's input; after its end, it returns zeros.
class Bytes {
 public:
  Bytes(const uint8_t* data, size_t size) : data_(data), size_(size) {}
  bool left() const { return at_ < size_; }
  uint32_t byte() { return at_ < size_ ? data_[at_++] : 0u; }
  uint32_t below(uint32_t n) { return (byte() << 8 | byte()) % n; }
  /// Returns a number from 0.0 to 1.0.
  float part() { return static_cast<float>(byte() << 8 | byte()) / 65535.0f; }
  float length(float least, float most) { return least + (most - least) * part(); }
  /// Returns a coordinate, mostly near `near`, sometimes at an end of the world.
  int32_t place(int32_t near) {
    const uint32_t kind = byte();
    if (kind == 255) return std::numeric_limits<int32_t>::max();
    if (kind == 254) return std::numeric_limits<int32_t>::min();
    return near + static_cast<int32_t>(below(65536)) - 32768;
  }

 private:
  const uint8_t* data_;
  size_t size_, at_ = 0;
};

class ChunkMaker {
 public:
  ChunkMaker(Bytes& bytes, Int3 near) : in_(bytes), near_(near) {
    chunk_.noises.push_back({place(), 1 + static_cast<int32_t>(in_.below(8192)), 1 + in_.below(6), in_.byte()});
    for (int i = 0; i < 5; ++i) chunk_.points.push_back(place());
    for (uint32_t i = 0, n = 3 + in_.below(12); i < n; ++i) expression();
  }

  GrammarChunk make() {
    const uint32_t groups = 1 + in_.below(6);
    for (uint32_t i = 0; i < groups && in_.left(); ++i) {
      Group g;
      g.root = shape(in_.below(5));
      g.cut = in_.byte() & 1;
      g.bounds =
          in_.byte() & 1 ? IntBox::everything() : IntBox{near_, near_}.grown(static_cast<int32_t>(in_.below(40000)));
      g.key = PathKey{in_.byte()}.child(1, i);
      chunk_.groups.push_back(g);
    }
    return std::move(chunk_);
  }

 private:
  Int3 place() { return {in_.place(near_.x), in_.place(near_.y), in_.place(near_.z)}; }

  void expression() {
    static constexpr ExprOp kOps[] = {ExprOp::constant, ExprOp::coordinate, ExprOp::noise,    ExprOp::sweep,
                                      ExprOp::negate,   ExprOp::absolute,   ExprOp::floor,    ExprOp::square_root,
                                      ExprOp::add,      ExprOp::subtract,   ExprOp::multiply, ExprOp::divide,
                                      ExprOp::minimum,  ExprOp::maximum,    ExprOp::less,     ExprOp::mix};
    const auto made = static_cast<uint32_t>(chunk_.exprs.size());
    Expr e;
    e.op = made == 0 ? ExprOp::coordinate : kOps[in_.below(std::size(kOps))];
    e.value = in_.length(-4, 4);
    e.anchor = place();
    e.row = {0.6f, 0.0f, 0.8f};
    if (e.op == ExprOp::noise) e.noise = 0;
    if (e.op == ExprOp::sweep) e.point_count = 2 + in_.below(4);
    if (e.op >= ExprOp::negate) e.a = in_.below(made);
    if (e.op >= ExprOp::add) e.b = in_.below(made);
    if (e.op == ExprOp::mix) e.c = in_.below(made);
    chunk_.exprs.push_back(e);
  }

  uint32_t shape(uint32_t depth) {
    Shape s;
    const bool leaf = depth == 0 || !in_.left();
    s.kind = static_cast<ShapeKind>(leaf ? in_.below(static_cast<uint32_t>(ShapeKind::prism) + 1)
                                         : in_.below(static_cast<uint32_t>(ShapeKind::warp) + 1));
    s.material = static_cast<uint16_t>(in_.below(4));
    s.tag = static_cast<uint16_t>(in_.below(4));
    for (float& size : s.size) size = in_.length(64, 12000);
    if (s.kind == ShapeKind::superquadric) s.size[3] = in_.length(2, kMaxPower);
    if (s.kind == ShapeKind::prism) s.point_count = 3 + in_.below(3);
    if (s.kind == ShapeKind::morph_power)
      for (size_t i = 0; i < 3; ++i) s.size[i + 3] = s.size[i] * in_.length(0.5f, 2.0f);
    s.inner_radius = s.kind == ShapeKind::sphere ? s.size[0] : 0.0f;
    s.frame.origin = place();
    s.amount = in_.length(16, 4000);
    const auto expressions = static_cast<uint32_t>(chunk_.exprs.size());
    const bool varies = in_.byte() & 1;
    if (s.kind == ShapeKind::morph || s.kind == ShapeKind::morph_power) {
      s.amount = in_.part();
      if (varies) s.expr = in_.below(expressions);
    }
    if (s.kind == ShapeKind::displace) s.expr = in_.below(expressions);
    if (s.kind == ShapeKind::warp) s.expr = in_.below(expressions - 2);
    std::vector<uint32_t> children;
    for (uint32_t i = 0, n = childCount(s.kind); i < n; ++i)
      children.push_back(s.kind == ShapeKind::sum ? ball() : shape(depth - 1));
    s.first_child = static_cast<uint32_t>(chunk_.children.size());
    s.child_count = static_cast<uint32_t>(children.size());
    chunk_.children.insert(chunk_.children.end(), children.begin(), children.end());
    chunk_.shapes.push_back(s);
    return static_cast<uint32_t>(chunk_.shapes.size() - 1);
  }

  uint32_t ball() {
    Shape s;
    s.size[0] = s.inner_radius = in_.length(64, 6000);
    s.frame.origin = place();
    chunk_.shapes.push_back(s);
    return static_cast<uint32_t>(chunk_.shapes.size() - 1);
  }

  uint32_t childCount(ShapeKind kind) {
    if (kind <= ShapeKind::prism || kind == ShapeKind::morph_power) return 0;
    if (kind == ShapeKind::morph) return 2;
    if (kind == ShapeKind::displace || kind == ShapeKind::warp) return 1;
    return 1 + in_.below(5);
  }

  Bytes& in_;
  Int3 near_;
  GrammarChunk chunk_;
};

std::vector<Brush> brushesFrom(Bytes& in, Int3 near) {
  std::vector<Brush> brushes;
  for (uint32_t n = in.below(4); n > 0; --n) {
    Brush b;
    b.shape = static_cast<Brush::Shape>(in.below(4));
    b.cut = in.byte() & 1;
    b.material = static_cast<uint16_t>(in.below(3));
    b.from = {in.place(near.x), in.place(near.y), in.place(near.z)};
    b.to = {in.place(near.x), in.place(near.y), in.place(near.z)};
    b.half = {in.place(0), in.place(2000), in.place(2000)};
    for (float& q : b.turn) q = in.length(-1, 1);
    b.radius = in.place(2000);
    b.smooth = in.byte() & 1 ? 0 : in.place(1000);
    if (checkBrush(b)) brushes.push_back(b);
  }
  return brushes;
}

struct Results {
  std::vector<int32_t> q;
  std::vector<int16_t> nx, ny;
  std::vector<uint32_t> label;
  friend bool operator==(const Results&, const Results&) = default;
};

Results evaluate(const FieldKernels& kernels, const ProgramView& program, const Points& points) {
  Results r{std::vector<int32_t>(points.count), std::vector<int16_t>(points.count), std::vector<int16_t>(points.count),
            std::vector<uint32_t>(points.count)};
  EvalScratch scratch;
  kernels.samples(program, points, scratch, r.q.data());
  Attributes out;
  out.normal_x = r.nx.data();
  out.normal_y = r.ny.data();
  out.label = r.label.data();
  kernels.attributes(program, points, scratch, out);
  return r;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Bytes in(data, size);
  static constexpr int32_t kPlaces[] = {0, 1 << 20, 2'000'000'000, -2'000'000'000};
  const int32_t middle = kPlaces[in.below(4)];
  const Int3 near{middle, -middle, middle};
  const GrammarChunk chunk = ChunkMaker(in, near).make();
  const GroupIndex index(chunk);
  const IndexedCell cell{&chunk, &index};
  FieldSettings settings;
  settings.finest_cell = settings.cell = 1 + static_cast<int32_t>(in.below(2048));
  settings.solid = in.byte() & 1;
  const int32_t step = 1 + static_cast<int32_t>(in.below(1024));
  const IntBox box = IntBox{near, near}.grown(step);
  const std::vector<Brush> brushes = brushesFrom(in, near);
  const Result<FieldProgram> program =
      compileField({&cell, 1}, box, settings, std::pmr::get_default_resource(), {}, brushes);
  if (!program) {
    require(!program.error().message.empty(), "an error without words");
    return 0;
  }

  std::vector<int32_t> x, y, z;
  for (int32_t i = 0; i < 27; ++i) {
    x.push_back(near.x + (i % 3 - 1) * step);
    y.push_back(near.y + (i / 3 % 3 - 1) * step);
    z.push_back(near.z + (i / 9 - 1) * step);
  }
  const Points points{x.data(), y.data(), z.data(), x.size()};
  const Results whole = evaluate(scalarKernels(), program->view(), points);
  for (const InstructionSet& set : instructionSets())
    if (set.runs_here)
      require(evaluate(*set.kernels, program->view(), points) == whole, "an instruction set gives other bits");

  PruneScratch scratch;
  PrunedProgram pruned;
  prune(program->view(), box, scratch, pruned);
  for (const int32_t q : whole.q) {
    require(!pruned.solid() || q < 0, "a box proven solid is not");
    require(!pruned.empty() || q >= 0, "a box proven empty is not");
  }
  if (!pruned.solid() && !pruned.empty())
    require(evaluate(scalarKernels(), pruned.view(), points) == whole, "pruning changed bits");
  return 0;
}
