#pragma once
// Checks names, arguments, dimensions and stages: turns the parser's result into a resolved Program.
//
// A parameter of a rule has one type, found from the first call. Lets and fields are checked anew for each tuple of
// argument types (with cached results), so that one `fbm` works for both lengths and ratios.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "grammar/syntax/name_table.h"
#include "grammar/syntax/program.h"
#include "grammar/syntax/syntax.h"
#include "grammar/text/limits.h"
#include "grammar/text/sink.h"

namespace sgm {

/// A scale around a call; `copied`: applied once for each copy.
struct ScaleAround {
  ExprId factor = kNoId;
  bool copied = false;
};

/// A call of a rule by a rule, for the checks of recursion, layers and reach.
struct RuleCall {
  uint32_t from = 0, alternative = 0;
  uint32_t to = 0;
  ExprId call = kNoId;
  bool escape = false;  ///< for depth or minsize
  bool shrunk = false;  ///< inside of size
  std::vector<ScaleAround> scales;
};

/// A probe or a query.
struct AskedLayer {
  uint32_t rule = 0;
  uint32_t layer = 0;
  Span span;
  std::string_view verb;  ///< the action of the rule on the layer: `probes`
};

struct WrittenPath;
struct WrittenStep;

class Checker {
 public:
  /// library: the root is a file for import, and derives nothing.
  Checker(Program& program, NameTable& names, std::vector<ModuleSyntax>& syntax, const CompileLimits& limits,
          DiagnosticSink& sink, bool library);

  /// Runs all checks except recursion and reach. Errors go to the sink.
  void run();

  const std::vector<RuleCall>& calls() const { return calls_; }
  /// Whether a used name may be declared in a part of the text that was not parsed.
  bool usesWhatIsLost() const { return uses_lost_; }

 private:
  struct Symbol {
    Ref ref = Ref::none;
    uint32_t id = 0;
    bool import = false;  ///< of a file: id is its module
    Span span;
    bool asset = false;  ///< id: Program::assets
  };
  struct Local {
    NameId name = kNoId;
    uint32_t slot = 0;
    Type type;
    uint32_t field = kNoId;  ///< a local field instead of a value
    size_t depth = 0;        ///< for a field: the number of locals before it
  };
  /// The context of an expression.
  struct Scope {
    uint32_t module = 0;
    bool rule = false;   ///< cell and scope are known, and rand needs no key
    bool field = false;  ///< in the body of a field
    std::vector<Local> locals;
    uint32_t next_slot = 0;
    uint32_t slot_count = 0;
    uint32_t* draws = nullptr;  ///< the counter of rand and chance
  };
  using Key = std::tuple<Ref, uint32_t, std::vector<std::tuple<int, int, int, bool, bool>>>;

  // check_collect.cpp
  void collect();
  /// Whether a name unknown in a module may be declared in a part of it that was not parsed.
  bool mayBeLost(uint32_t module, NameId name);
  /// Whether parts of a statement may be missing because they were not parsed.
  bool isLossy(const StmtNode& s) const { return !syntax_[s.span.file].complete; }
  void declare(ModuleSyntax& module, NameId name, Symbol symbol);
  uint16_t tableIndex(std::pmr::vector<std::pmr::string>& table, NameId name, const Span& span);

  // check_domain.cpp
  /// The ends of a range; rangeOf gives nullopt, and defaultLies false, after an error.
  struct Ends {
    double low = 0, high = 0;
  };
  std::optional<Ends> rangeOf(ExprId low_expr, ExprId high_expr, Dim dim);
  bool defaultLies(const Ends& range, ExprId value_expr, double value, Dim dim, NameId name);
  void formalRanges();
  void params();
  void seedAndDomain();
  void layers();
  void sortLayers();
  void keepCalls();
  void expectations();
  std::optional<double> constant(ExprId id, Dim dim, std::string_view what);
  std::optional<int64_t> wholeUnits(ExprId id, std::string_view what);

  std::optional<double> fold(ExprId id, int depth);

  // check_statements.cpp, check_placement.cpp, check_split.cpp
  void checkRules();
  void headRanges(const Rule& rule, const Alternative& head);
  void checkWaiting();
  void checkUnusedValues();
  void checkRule(uint32_t rule);
  void checkAlternative(uint32_t rule, uint32_t alternative);
  void statement(StmtId id, bool shrunk);
  void blockStatements(const StmtNode& node, bool shrunk);
  void detail(const StmtNode& s, bool shrunk);
  void morphStatement(const StmtNode& node, bool shrunk);
  void forEach(StmtId id, const StmtNode& node, bool shrunk);
  void scatterStatement(const StmtNode& node, bool shrunk);
  void splitStatement(const StmtNode& node);
  void snapStatement(const StmtNode& node, bool shrunk);
  void partStatements(const StmtNode& node);
  // check_treemap.cpp
  void treemap(const StmtNode& node);
  /// Returns whether it names two rooms.
  bool link(const StmtNode& node, const std::vector<NameId>& rooms);
  // check_wfc.cpp
  void wave(const StmtNode& node);
  void waveSize(ExprId size);
  void waveSides(const StmtNode& node);
  void waveAnswers(const StmtNode& node);
  void unmetSide(const PartNode& part, const SocketNode& socket, size_t side, uint64_t there, const WaveNode& wave);
  std::string labelsText(IdRange labels) const;
  bool xforms(IdRange range, bool copied);
  bool unknownAxis(ExprId axis);
  void localField(const StmtNode& node);
  void callRule(ExprId call, bool escape, bool shrunk);
  void markLayerLevel(StmtId id);
  void idleCuts(StmtId id, bool first);
  void idleCutsIn(StmtId block);
  void declareLocal(NameId name, const Span& span, Local local);
  bool sumLeaf(StmtId id);

  // check_below.cpp
  /// Finds the layer by name, queried by the current rule or override; kNoId after an error.
  uint32_t layerBelow(NameId name, const Span& span, std::string_view verb);
  Type query(ExprId id);
  void layersAsked();

  // check_fit.cpp
  void assetMaterials();
  void assetMisused(const Span& span, NameId name);
  void fit(const StmtNode& node);

  // check_profiles.cpp
  void footprint(StmtId id, const StmtNode& node);
  void extrude(const StmtNode& node, bool shrunk);
  void roof(const StmtNode& node);
  void planOf(const StmtNode& node);
  bool planUnknown(ExprId plan);
  /// Like demand() for a number; a constant must also lie in a range.
  void demandRange(ExprId id, Dim dim, std::string_view what, const ValueRange& range);

  // check_overrides.cpp
  void overrides();
  std::string tagMeant(std::string_view path) const;
  void overridePath(Override& edit);
  bool overrideCell(Override& edit, const WrittenPath& written);
  uint32_t ruleOfStep(uint32_t module, const WrittenStep& step);
  void headsAgree(const Override& edit, uint32_t rule, uint32_t parameter);
  void overrideBlock(uint32_t index);
  void overrideTags();
  void tagRooms();
  void orderPaths();
  void hiddenOverrides();
  void usesThatNeverCome();  // check_uses.cpp
  void holdOverrides();
  void markOverrides(IdRange overrides, bool cuts);
  void markOverride(uint32_t index, bool cuts);
  bool cutsDomain(StmtId id) const;

  // check_bind.cpp
  struct FormalView {
    std::string_view name;
    ExprId fallback = kNoId;
    bool required = true;
    bool named_only = false;
  };
  /// Combine positional and named arguments to one list; bind returns false after an error.
  NameId meantByDifference(const ArgNode& arg, const std::vector<FormalView>& formals) const;
  bool bind(ExprId call, std::string_view callee, const std::vector<FormalView>& formals, bool variadic,
            std::vector<uint32_t>& bound);
  std::vector<FormalView> viewOf(IdRange formals) const;
  /// The types of formals before arguments are known: the dimension of those with a range.
  std::vector<Type> typesOf(IdRange formals) const;
  /// Requires that arguments have the dimension of their formal's range; continues as if they had, so that one error is
  /// reported once.
  void demandRanged(IdRange formals, std::span<const uint32_t> bound, std::span<Type> types, std::string_view callee);
  std::vector<FormalView> viewOf(std::span<const BuiltinParam> params) const;
  /// Binds the written arguments of a transform or area, by position or name, to up to three expressions.
  bool bindWords(IdRange args, const Span& span, std::string_view callee, std::initializer_list<std::string_view> words,
                 size_t required, ExprId* out);
  bool resolveCallee(ExprId call, bool shape);
  bool notImported(const ExprNode& receiver, bool shape);
  void offerNames(Suggestion& suggestion, bool calls) const;
  void unknownName(const Span& span, NameId name, bool call, bool shape);

  // check_expressions.cpp, check_members.cpp, check_calls.cpp
  Type expression(ExprId id);
  Type name(ExprId id);
  Type member(ExprId id);
  Type binary(ExprId id);
  Type conditional(ExprId id);
  Type callValue(ExprId id);
  Type builtinCall(ExprId id);
  void branchRanges(const std::vector<uint32_t>& bound);
  Type method(ExprId id);
  bool fitsDeeper(ExprId id);
  Type letOrField(ExprId id, Ref ref, uint32_t index, const std::vector<Type>& args);
  Type localFieldUse(ExprId id, const Local& local);
  void primitiveCall(ExprId id);
  Type unify(const Type& a, const Type& b, bool& good) const;
  /// Checks arguments against a builtin's parameters, each expression once. Returns the common dimension of the
  /// parameters of any dimension; nullopt if all these arguments are a literal 0.
  std::optional<Dim> arguments(const std::vector<uint32_t>& bound, std::span<const BuiltinParam> params,
                               std::string_view callee);
  /// Like expression(), but requires a kind, a dimension and a stage. what: "the radius of ...".
  Type demand(ExprId id, ValueKind kind, Dim dim, std::string_view what, bool sample = false);
  /// The same for an expression with a known type: no expression is checked twice, so that nesting stays cheap.
  void demandType(ExprId id, const Type& type, ValueKind kind, Dim dim, std::string_view what, bool sample = false);
  bool literal(ExprId id) const;
  bool agrees(const Type& type, ValueKind kind, Dim dim) const;
  void deriveOnly(ExprId id, std::string_view what);
  /// The innermost part of an expression that makes it a sample-time one.
  ExprId culprit(ExprId id) const;
  std::string unitHint(ExprId id, const Type& type, Dim wanted) const;

  ExprNode& node(ExprId id) { return program_.ast.exprs[id]; }
  const ExprNode& node(ExprId id) const { return program_.ast.exprs[id]; }
  std::string_view text(NameId id) const { return program_.text(id); }
  uint32_t child(const ExprNode& n, uint32_t i) const { return program_.ast.ids[n.children.first + i]; }
  IdRange store(const std::vector<uint32_t>& ids);

  Program& program_;
  NameTable& names_;
  std::vector<ModuleSyntax>& syntax_;
  CompileLimits limits_;
  DiagnosticSink& sink_;
  std::vector<std::map<NameId, Symbol>> symbols_;
  Scope scope_;
  std::map<Key, Type> known_;        ///< cached results of lets and global fields
  std::map<Key, Type> known_local_;  ///< the same for local fields, within one alternative
  std::vector<std::pair<Ref, uint32_t>> open_;
  std::vector<std::vector<Type>> rule_types_;
  std::vector<uint8_t> rule_state_;  ///< 0 not reached, 1 waiting, 2 checked
  std::vector<uint32_t> waiting_;
  size_t next_waiting_ = 0;
  std::set<uint32_t> checked_;  ///< rules that were checked at least once
  std::vector<RuleCall> calls_;
  std::vector<ScaleAround> scales_;    ///< around the statement being checked
  std::map<uint32_t, double> folded_;  ///< cached values of lets
  std::vector<AskedLayer> asked_;
  std::vector<bool> start_rules_;
  std::vector<std::set<std::pair<uint32_t, NameId>>> callees_;  ///< for each rule: rules, and their import
  std::vector<std::vector<uint32_t>> override_calls_;           ///< for each override: rules
  std::vector<std::vector<AskedLayer>> override_asked_;         ///< for each override; its rule is not known yet
  std::set<uint32_t> level_overrides_;                          ///< those that may be used at the level of a layer
  std::set<uint32_t> room_overrides_;                           ///< those that may be used in a treemap's room
  uint32_t rule_ = 0, alternative_ = 0;
  uint32_t override_ = kNoId;  ///< the override whose block is checked, if it is not a rule's
  uint32_t ordinal_ = 0, draws_ = 0;
  int expression_depth_ = 0;
  const bool library_;
  const uint32_t errors_before_;  ///< errors of loading and parsing
  const bool lossy_;              ///< there were such errors: a part of the text is missing
  bool uses_lost_ = false;
  bool layers_known_ = false;  ///< if false, messages about layers would only follow from another error
};

/// Reports an error for every rule that may call itself without end. Sets ExprNode::circular.
void checkRecursion(Program& program, const std::vector<RuleCall>& calls, const CompileLimits& limits,
                    DiagnosticSink& sink);

/// Checks every call, derived or not, whose arguments lie outside of the ranges of a rule, let or field, if that does
/// not depend on the frame. checkReach() checks the rest, where the frame is known.
void checkRanges(const Program& program, const CompileLimits& limits, DiagnosticSink& sink);

/// Sets Layer::coarsest_cell and Layer::anchors. Precondition: the program has no errors.
void findLayerContents(Program& program, const CompileLimits& limits);

}  // namespace sgm
