#pragma once
// The interpreter of one cell. Internal to derive/: everything outside calls deriveCell() (derive.h).
//
// evaluate.cpp: expressions. functions.cpp: the language's functions. statements.cpp: blocks and combiners. morph.cpp:
// morphs. split.cpp: parts of scopes. rules.cpp: choice and calls. points.cpp: transforms, loops, point sets.
// primitives.cpp: leaves. voxels.cpp: leaves of cellular automata. profiles.cpp: footprints and roofs. assets.cpp:
// assets fitted into scopes. rooms.cpp: floors in rooms. tiles.cpp: lattices of tiles. overrides.cpp: replaced blocks.
// derive.cpp: the cell as a whole. instances.cpp: the activations of one rule in it.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "derive/bounds.h"
#include "derive/draft.h"
#include "derive/frame.h"
#include "derive/interpret/derive.h"
#include "derive/lattice.h"
#include "derive/layout/floor_plan.h"
#include "derive/layout/plan.h"
#include "derive/layout/skeleton.h"
#include "derive/layout/wave_collapse.h"

namespace sgm {

/// A value of the language. Numbers, vectors and pairs use n; a cell uses `cell`, a face also `axis`; a range uses n[0]
/// and n[1]; a segment uses `first`; a list of segments and a plan also use `count`.
struct Value {
  ValueKind kind = ValueKind::number;
  std::array<Num, 3> n{};
  Int3 cell;
  int axis = 0;
  std::vector<FaceId> faces;
  uint32_t first = 0, count = 0;  ///< of the interpreter's segments or pieces of plans

  static Value number(Num v) {
    Value result;
    result.n[0] = v;
    return result;
  }
  static Value number(double v) { return number(Num{v}); }
  static Value boolean(Num v) {
    Value result = number(v);
    result.kind = ValueKind::boolean;
    return result;
  }
  static Value vector(Num x, Num y, Num z) {
    Value result;
    result.kind = ValueKind::vector;
    result.n = {x, y, z};
    return result;
  }
  static Value vector(Vec3 v) { return vector({v.x}, {v.y}, {v.z}); }
  static Value ofCell(Int3 c) {
    Value result;
    result.kind = ValueKind::cell;
    result.cell = c;
    return result;
  }
  static Value ofFace(FaceId f) {
    Value result = ofCell(f.lower);
    result.kind = ValueKind::face;
    result.axis = f.axis;
    return result;
  }
  static Value ofFaces(std::vector<FaceId> list) {
    Value result;
    result.kind = ValueKind::faces;
    result.faces = std::move(list);
    return result;
  }
  static Value ofSegment(uint32_t index) {
    Value result;
    result.kind = ValueKind::segment;
    result.first = index;
    return result;
  }
  static Value ofSegments(uint32_t first, uint32_t count) {
    Value result = ofSegment(first);
    result.kind = ValueKind::segments;
    result.count = count;
    return result;
  }
  static Value ofPlan(uint32_t first, uint32_t count) {
    Value result = ofSegments(first, count);
    result.kind = ValueKind::plan;
    return result;
  }
  double real() const { return n[0].value; }
  bool truth() const { return n[0].value != 0; }
  Vec3 vec() const { return {n[0].value, n[1].value, n[2].value}; }
  FaceId face() const { return {cell, axis}; }
};

/// A range of the overrides by path that may apply in the cell, in the order of Program::path_overrides.
struct PathRange {
  uint32_t first = 0, end = 0;
};

/// One activation of a rule, or of an override's block.
struct Activation {
  uint32_t rule = 0;
  uint32_t edit = kNone;     ///< index in Program::overrides if a block: below the activation that it replaces
  NameId qualifier = kNoId;  ///< of the rule in its call: `cave` of cave.Hall
  uint32_t parent = kNone;
  uint32_t index = 0;                  ///< among the parent's activations of the same rule, for the readable path
  Placement start;                     ///< the initial scope of the rule
  std::vector<PathRange> leads;        ///< the overrides by path whose first steps lead here
  uint32_t steps = 0;                  ///< the number of these steps
  std::vector<uint32_t> child_counts;  ///< pairs: rule, activations
};

struct Env;
struct FittedAsset;
struct StandingTiles;

/// Planes to which the lines of nested splits snap: across `normal`, every `distance` metres of the cell from `first`.
struct SnapPlanes {
  Vec3 normal;
  double first = 0, distance = 1;
  const SnapPlanes* outer = nullptr;
};

/// The overrides by tag whose own block contains the current statement.
struct OwnBlock {
  uint32_t edit = 0;
  const OwnBlock* outer = nullptr;
};

/// The target of overrides; for an override's block, the content that its `inner` derives.
struct UnderEdit {
  const Rule* rule = nullptr;  ///< an activation of it, with these arguments
  std::vector<Value>* arguments = nullptr;
  const StmtNode* statement = nullptr;  ///< or a block with a tag
  const std::vector<uint32_t>& edits;   ///< that apply, as in Program::overrides
  size_t at = 0;                        ///< the current override, an index into `edits`
  const Env* env = nullptr;             ///< the environment of the target
  PathKey own_key;                      ///< of the block
  bool room = false;                    ///< the block belongs to a room, to which it adds and from which it cuts
};

/// The environment of a statement or an expression.
struct Env {
  Placement place;
  Vec3 scope;  ///< edges of the scope's box, metres
  PathKey key;
  uint32_t activation = 0;
  uint16_t material = 0, tag = 0;
  uint32_t sweep = kNone;  ///< the polyline that is the domain of `u`
  int32_t cut_detail = 0;  ///< of a `detail` directly before a cut
  bool anchors = true;
  bool whole = false;  ///< no part may be left out: an enclosing statement makes one shape of all of them
  bool top = false;    ///< the layer's own activation of its start rule, in which a cut removes from the domain
  std::vector<Value>* slots = nullptr;
  uint16_t forced_material = 0, forced_tag = 0;    ///< of an override around `inner`: take precedence over a block's
  uint16_t written_material = 0, written_tag = 0;  ///< set by a block since the override's began
  const OwnBlock* within = nullptr;
  const UnderEdit* under = nullptr;
  const SnapPlanes* snaps = nullptr;
};

using ShapeList = std::vector<uint32_t>;

/// The output of one call of the watched rule.
struct WatchedCall {
  uint32_t activation = 0;
  ShapeList shapes, layer_cuts;
  size_t first_anchor = 0, end_anchor = 0;
};

/// The exponent of a superquadric: 2 at 0, kMaxPower at 1.
double exponentOfSquare(double square);

class Interpreter {
 public:
  Interpreter(const Program& program, const ParameterValues& parameters, uint64_t world_seed, uint32_t layer, Int3 cell,
              const LowerLayers& lower, const DeriveLimits& limits, std::pmr::memory_resource* memory);

  Result<GrammarChunk> run(std::pmr::memory_resource* memory);

  /// Same as run(), with the origins of the shapes.
  Result<TracedCell> runTraced(std::pmr::memory_resource* memory);

  /// Same as run(), but without the shapes that deriveCoarseCell() leaves out.
  Result<GrammarChunk> runCoarse(int32_t cell_edge, std::pmr::memory_resource* memory);
  Result<std::vector<RuleInstance>> runInstances(uint32_t rule, std::pmr::memory_resource* memory);

 private:
  /// Counts one more level of recursion during its lifetime.
  class Nested {
   public:
    explicit Nested(uint32_t& depth) : depth_(depth) { ++depth_; }
    ~Nested() { --depth_; }
    Nested(const Nested&) = delete;
    Nested& operator=(const Nested&) = delete;

   private:
    uint32_t& depth_;
  };

  // Expressions. After a limit is reached, they return zeros and failed() is true.
  Value evaluate(ExprId id, const Env& env);
  Value evaluateBinary(const ExprNode& node, const Env& env);
  Value evaluateName(const ExprNode& node, const Env& env);
  Value evaluateMember(const ExprNode& node, const Env& env);
  Value evaluateCall(const ExprNode& node, const Env& env);
  Value evaluateBuiltin(const ExprNode& node, const Env& env);
  Value evaluatePure(const ExprNode& node, const Env& env);      ///< arithmetic
  Value evaluateRandom(const ExprNode& node, const Env& env);    ///< rand, chance
  Value evaluateCellular(const ExprNode& node, const Env& env);  ///< cells, faces, noise
  Value evaluateBranch(const ExprNode& node, const Env& env);
  Value evaluateQuery(const ExprNode& node, const Env& env);
  Value evaluateLet(const ExprNode& node, const Env& env);
  Value evaluateField(const ExprNode& node, const Env& env);
  Value sampleCoordinates(const Env& env, bool local);
  Value pointValue(Int3 units_from_cell, const Env& env) const;
  Vec3 cellOrigin() const;
  double realArgument(const ExprNode& node, uint32_t index, const Env& env);
  Value argument(const ExprNode& node, uint32_t index, const Env& env);
  uint32_t boundAt(const ExprNode& node, uint32_t index) const;
  PathKey keyOf(const Value& key) const;
  double real(ExprId id, const Env& env) { return evaluate(id, env).real(); }

  // Statements. They append the shapes that they add to their block to `out`.
  void statement(StmtId id, const Env& env, ShapeList& out);
  void block(const StmtNode& s, const Env& env, ShapeList& out);
  /// The statements of a block, evaluated as if they were in the block of `out`.
  void contents(const StmtNode& s, const Env& env, ShapeList& out);
  void label(const StmtNode& block, Env& env) const;
  void call(ExprId id, uint32_t ordinal, const Env& env, ShapeList& out);
  void cut(const StmtNode& s, const Env& env, ShapeList& out);
  void meet(const StmtNode& s, const Env& env, ShapeList& out);
  void uniteSmooth(const StmtNode& s, const Env& env, ShapeList& out);
  void sum(const StmtNode& s, const Env& env, ShapeList& out);
  void morph(const StmtNode& s, const Env& env, ShapeList& out);
  void morphPower(const StmtNode& s, const Env& env, uint32_t a, uint32_t b, Num t, ShapeList& out);
  void displace(const StmtNode& s, const Env& env, ShapeList& out);
  void warp(const StmtNode& s, const Env& env, ShapeList& out);
  std::array<Num, 3> inWorld(const std::array<Num, 3>& local, const Placement& place);
  void repeat(const StmtNode& s, const Env& env, ShapeList& out);
  void forEach(const StmtNode& s, const Env& env, ShapeList& out);
  void scatter(const StmtNode& s, const Env& env, ShapeList& out);
  void scatterPoints(const StmtNode& s, const Env& env, ShapeList& out);
  void noteBuried(const StmtNode& s, const Env& env);
  void scatterPoint(const StmtNode& s, const Env& at, ShapeList& out);
  bool probe(const ScatterNode& node, Env& env);
  void split(const StmtNode& s, const Env& env, ShapeList& out);
  void snap(const StmtNode& s, const Env& env, ShapeList& out);
  void comp(const StmtNode& s, const Env& env, ShapeList& out);
  /// Derives a part as a block of its own in `scope` at `place`; number: of the part, for its key.
  void part(const StmtNode& s, uint32_t index, uint64_t number, const Placement& place, Vec3 scope, const Env& env,
            ShapeList& out);
  void treemap(const StmtNode& s, const Env& env, ShapeList& out);
  FloorPlan floorPlan(const FloorPlanSizes& sizes, std::span<const double> areas, std::span<const RoomLink> links,
                      const Span& span, const Env& env);
  double floorMeasure(ExprId id, double fallback, const ValueRange& range, const Env& env);
  void planBox(const PlanRect& r, double y, double height, const StmtNode& s, const Env& env, ShapeList& out);
  /// index: of the part that describes the room, or kNone.
  void roomAt(const StmtNode& s, uint32_t index, std::span<const PlanRect> clear, PathKey key, const Env& env,
              ShapeList& out);
  void facades(const StmtNode& s, const FloorPlan& plan, std::span<const PathKey> keys, const Env& env, ShapeList& out);
  void wave(const StmtNode& s, const Env& env, ShapeList& out);
  /// False, with a note, if there is nothing to fill, or no tile to fill it with.
  bool waveLattice(const StmtNode& s, const Env& env, WaveLattice& lattice);
  bool waveTiles(const StmtNode& s, const Env& env, StandingTiles& tiles);
  void noteNoTiles(const StmtNode& s, const StandingTiles& standing, const WaveLattice& lattice,
                   const WaveResult& result, const Env& env);
  void footprint(const StmtNode& s, const Env& env);
  std::optional<PlanPiece> planPiece(const FootprintNode& node, const Env& env);
  void extrude(const StmtNode& s, const Env& env, ShapeList& out);
  void roof(const StmtNode& s, const Env& env, ShapeList& out);
  void roofOver(const PlanPiece& piece, double floor, const StmtNode& s, const Env& env, ShapeList& out);
  void fit(const StmtNode& s, const Env& env, ShapeList& out);
  const FittedAsset& fittedAsset(const FitNode& node, const Env& env, const Span& span);
  void anchor(const StmtNode& s, const Env& env);
  void detail(const StmtNode& s, const Env& env, ShapeList& out);
  void transform(IdRange xforms, Env& env);
  void limitLevels(ShapeList& list, size_t from, int32_t coarsest, int32_t detail);
  /// True if this derivation is for levels that do not show shapes with this `detail`, and nothing else depends on
  /// them.
  bool skips(int32_t detail, const Env& env) const { return !env.whole && detail > 0 && coarse_edge_ > detail; }

  // Rules.
  void callRule(uint32_t rule, const ExprNode& node, uint32_t ordinal, const Env& env, ShapeList& out);
  void derive(const Rule& rule, const Alternative& chosen, Env& env, std::vector<Value>& arguments, ShapeList& out);
  bool passes(const Alternative& alternative, Env& env, std::vector<Value>& arguments);
  void alternatives(const Rule& rule, Env env, std::vector<Value>& arguments, ShapeList& out);
  const Alternative* choose(const std::vector<const Alternative*>& from, Env& env, std::vector<Value>& arguments,
                            uint64_t draw);

  // Overrides.
  void findOverrides();
  bool isAt(uint32_t activation, const Override& edit, uint32_t count) const;
  std::vector<uint32_t> enterPaths(uint32_t activation);
  std::vector<uint32_t> overridesOf(uint16_t tag, const Env& env) const;
  /// Applies the first `below` overrides.
  void use(const UnderEdit& what, size_t below, Env& env, ShapeList& out);
  void overridden(const UnderEdit& what, size_t at, const Env& env, ShapeList& out);
  void inner(const StmtNode& s, const Env& env, ShapeList& out);
  void tagged(const StmtNode& s, uint16_t tag, const Env& env, ShapeList& out, bool room = false);
  void untagged(const StmtNode& s, const Env& env, ShapeList& out);
  void noteMissed();

  // Leaves.
  void primitive(Primitive kind, const ExprNode& node, uint32_t ordinal, const Env& env, ShapeList& out);
  void addLeaf(Shape shape, std::initializer_list<double> metres, double inner, const ExprNode& node, uint32_t ordinal,
               const Env& env, ShapeList& out);
  void boxLeaf(const ExprNode& node, uint32_t ordinal, const Env& env, ShapeList& out);
  void sweptLeaf(bool square, const ExprNode& node, uint32_t ordinal, const Env& env, ShapeList& out);
  void prismLeaf(const ExprNode& node, uint32_t ordinal, const Env& env, ShapeList& out);
  /// A profile that stands on y = 0, metres; x, z: edges of its box.
  struct Profile {
    std::vector<PlanCorner> corners;
    double x, z, height;
  };
  std::optional<uint32_t> prismShape(const Profile& profile, const Placement& place, uint32_t ordinal, const Span& span,
                                     const Env& env);
  void halfspaceLeaf(const ExprNode& node, uint32_t ordinal, const Env& env, ShapeList& out);
  void automatonLeaf(const ExprNode& node, uint32_t ordinal, const Env& env, ShapeList& out);

  // Nodes.
  Shape shapeIn(const Env& env, ShapeKind kind) const;
  uint32_t addShape(Shape s, uint32_t ordinal, const Span& span, const Env& env, const ShapeList& children = {});
  /// One node for a non-empty list: its only element, or a hard union.
  uint32_t united(const ShapeList& list, const StmtNode& s, const Env& env);
  std::optional<double> smoothRadius(const StmtNode& s, const Env& env);

  // Errors and notes.
  bool step(uint64_t count, const Span& span, uint32_t activation);
  bool withinBytes(const Span& span, uint32_t activation);
  bool withinNesting(const Span& span, uint32_t activation);
  void fail(const std::string& what, const Span& span, uint32_t activation);
  bool failed() const { return error_.has_value(); }
  void note(const std::string& message, const Span& span, uint32_t activation);
  std::string pathText(uint32_t activation) const;
  uint32_t outsideOfEdits(uint32_t activation) const;

  /// from: if not null, receives each shape's index in the draft.
  Result<GrammarChunk> derived(std::vector<uint32_t>* from, std::pmr::memory_resource* memory);
  /// Derives the layer's start; returns the shapes that it adds.
  ShapeList start();
  void collectGroups(const ShapeList& list, bool cut, GrammarChunk& out);
  /// Adds a group that is within the cell's limit, and checks it against the proven bounds of the layer.
  void addGroup(Group group, GrammarChunk& out);
  /// Notes a shape that is left out because its box exceeds the limit of the cell.
  void noteBeyond(uint32_t shape, const IntBox& box);
  /// Returns false if a shape is unbounded.
  bool collectAlone(const ShapeBounds& bounds, const ShapeList& list, bool cut, std::vector<Group>& out) const;

  const Program& program_;
  const ParameterValues& parameters_;
  const Layer& layer_;
  const LowerLayers& lower_;
  const DeriveLimits& limits_;
  uint32_t layer_index_;
  uint64_t seed_;  ///< of the world and the grammar
  Int3 cell_;
  Lattice lattice_;
  Int3 base_;  ///< low corner of the cell, units
  Draft draft_;
  /// The overrides by path that may apply in this cell.
  struct PathOverride {
    uint32_t index = 0;
    bool found = false;
  };
  std::vector<PathOverride> path_overrides_;
  std::vector<Activation> activations_;
  std::vector<uint32_t> active_;  ///< for each rule: number of its activations on the path
  ShapeList layer_cuts_;
  std::vector<Anchor> anchors_;
  std::vector<Segment> segments_;  ///< of all skeletons
  std::vector<PlanPiece> plans_;   ///< of all footprints
  /// Assets in the sizes to which they were fitted so far, by asset, size and zones.
  std::map<std::vector<uint64_t>, std::shared_ptr<const FittedAsset>> fitted_;
  /// Some of the floor plans so far, by all inputs.
  std::map<std::vector<uint64_t>, FloorPlan> floor_plans_;
  int32_t coarse_edge_ = 0;  ///< derive only for levels with this cell edge or a larger one; 0: for all
  uint32_t watched_rule_ = kNone;
  std::vector<WatchedCall> watched_;
  /// The points of the current scatter: the number of probed ones, and of those that began inside a solid.
  struct ProbedPoints {
    uint64_t all = 0, buried = 0;
  } probed_;
  std::vector<DeriveNote> notes_;
  uint64_t dropped_notes_ = 0;
  uint64_t parameters_read_ = 0;
  uint64_t steps_ = 0;
  uint32_t depth_ = 0, nesting_ = 0;
  std::optional<Error> error_;
};

}  // namespace sgm
