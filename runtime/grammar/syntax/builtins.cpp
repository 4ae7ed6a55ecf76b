#include "grammar/syntax/builtins.h"

#include <algorithm>
#include <array>

#include "base/math.h"

namespace sgm {

namespace {

using P = BuiltinParam;

/// A parameter that takes a number of any dimension, known at derivation time or only at sample time. The first such
/// argument of a call determines the dimension of the others.
constexpr P any(std::string_view name) { return {name, ValueKind::number, kRatio, true, true, 0, false, false}; }
/// A parameter that takes a ratio. The argument may be known at derivation time or only at sample time.
constexpr P ratio(std::string_view name) { return {name, ValueKind::number, kRatio, false, true, 0, false, false}; }
constexpr P derived(P p) { return p.derive_only = true, p; }
constexpr P number(std::string_view name, Dim dim) { return {name, ValueKind::number, dim}; }
constexpr P option(std::string_view name, Dim dim, double fallback) {
  return {name, ValueKind::number, dim, false, false, fallback};
}
constexpr P of(std::string_view name, ValueKind kind, Dim dim = kRatio) { return {name, kind, dim}; }
constexpr P named(P p) { return p.named_only = true, p; }

constexpr std::array kMin = {any("a"), any("b")};
constexpr std::array kOne = {any("a")};
constexpr std::array kOneRatio = {ratio("a")};
constexpr std::array kOneRatioDerived = {derived(ratio("a"))};
constexpr std::array kMix = {any("a"), any("b"), ratio("t")};
constexpr std::array kClamp = {any("a"), any("low"), any("high")};
constexpr std::array kSmoothstep = {derived(any("low")), derived(any("high")), any("x")};
constexpr std::array kAngleOnly = {number("angle", kAngle)};
constexpr std::array kAtan2 = {derived(any("y")), derived(any("x"))};
constexpr std::array kPow = {number("a", kRatio), number("b", kRatio)};
constexpr std::array kLengthOf = {of("v", ValueKind::vector, kLength)};
constexpr std::array kRand = {derived(any("a")), derived(any("b"))};
constexpr std::array kRandKeyed = {of("key", ValueKind::unknown), derived(any("a")), derived(any("b"))};
constexpr std::array kChance = {number("p", kRatio)};
constexpr std::array kChanceKeyed = {of("key", ValueKind::unknown), number("p", kRatio)};
constexpr std::array kCellNoise = {of("cell", ValueKind::cell), number("period", kLength), option("salt", kRatio, 0)};
constexpr std::array kFractal = {number("period", kLength), option("octaves", kRatio, 1), option("salt", kRatio, 0)};
constexpr std::array kPoint = {option("jitter", kRatio, 0.5)};
constexpr std::array kLinks = {option("tree", kRatio, 3), option("extra", kRatio, 0)};
constexpr std::array kVec = {any("x"), any("y"), any("z")};
constexpr std::array kBranch = {number("n", kRatio), named(number("step", kLength)), named(number("turn", kAngle)),
                                named(option("fork", kRatio, 0))};

// The minimum of `step` is 1e-9 m instead of 0, so that a step of 0 is rejected. The maximum of `turn` has a tolerance,
// since 90deg may be rounded upwards.
constexpr std::array<ValueRange, 4> kBranchRanges = {
    {{0, kMaxSegments, "a branch takes 0 to 4096 steps", "raise `step` instead"},
     {1e-9, 1e9, "the `step` of a branch is a length above 0", "such as step 6m"},
     {0, kPi / 2 * (1 + 1e-12), "the `turn` of a branch is 0deg to 90deg", "such as turn 25deg"},
     {0, 1, "the `fork` of a branch is 0% to 100%", "such as fork 20%"}}};
static_assert(kMaxSegments == 4096);

constexpr std::array<BuiltinInfo, 26> kBuiltins = {{{"min", Builtin::min, kMin},
                                                    {"max", Builtin::max, kMin},
                                                    {"abs", Builtin::abs, kOne},
                                                    {"floor", Builtin::floor, kOneRatio},
                                                    {"ceil", Builtin::ceil, kOneRatioDerived},
                                                    {"sqrt", Builtin::sqrt, kOne},
                                                    {"mix", Builtin::mix, kMix},
                                                    {"clamp", Builtin::clamp, kClamp},
                                                    {"smoothstep", Builtin::smoothstep, kSmoothstep},
                                                    {"fract", Builtin::fract, kOneRatio},
                                                    {"sin", Builtin::sin, kAngleOnly},
                                                    {"cos", Builtin::cos, kAngleOnly},
                                                    {"atan2", Builtin::atan2, kAtan2},
                                                    {"pow", Builtin::pow, kPow},
                                                    {"length", Builtin::length, kLengthOf},
                                                    {"rand", Builtin::rand, kRand},
                                                    {"rand", Builtin::rand_keyed, kRandKeyed},
                                                    {"chance", Builtin::chance, kChance},
                                                    {"chance", Builtin::chance_keyed, kChanceKeyed},
                                                    {"cellnoise", Builtin::cell_noise, kCellNoise},
                                                    {"fractal", Builtin::fractal, kFractal},
                                                    {"point", Builtin::cell_point, kPoint},
                                                    {"links", Builtin::cell_links, kLinks},
                                                    {"point", Builtin::face_point, kPoint},
                                                    {"vec", Builtin::position, kVec},
                                                    {"branch", Builtin::branch, kBranch}}};

constexpr std::array kRadius = {number("r", kLength)};
constexpr std::array kBox = {number("x", kLength), number("y", kLength), number("z", kLength)};
constexpr std::array kCylinder = {number("r", kLength), number("h", kLength)};
constexpr std::array kTruncone = {number("h", kLength), number("top", kLength), number("bottom", kLength)};
constexpr std::array kCapsule = {of("a", ValueKind::vector, kLength), of("b", ValueKind::vector, kLength),
                                 number("r", kLength)};
constexpr std::array kTorus = {number("ring", kLength), number("tube", kLength)};
constexpr std::array kSuperq = {of("radii", ValueKind::vector, kLength), number("square", kRatio)};
constexpr std::array kHalfspace = {named(option("below", kLength, 0)), named(option("above", kLength, 0))};
constexpr std::array kTube = {of("a", ValueKind::vector, kLength), of("b", ValueKind::vector, kLength),
                              number("r", kLength), option("bend", kLength, 0)};
constexpr std::array kPrism = {number("h", kLength), of("corner", ValueKind::pair, kLength),
                               of("corner", ValueKind::pair, kLength), of("corner", ValueKind::pair, kLength)};
constexpr std::array kCa = {number("voxel", kLength),         option("fill", kRatio, 0.45), option("rounds", kRatio, 4),
                            option("threshold", kRatio, 0.5), option("radius", kRatio, 1),  option("salt", kRatio, 0)};

constexpr std::array<PrimitiveInfo, 14> kPrimitives = {{{"sphere", Primitive::sphere, kRadius},
                                                        {"box", Primitive::box, kBox},
                                                        {"cylinder", Primitive::cylinder, kCylinder},
                                                        {"truncone", Primitive::truncone, kTruncone},
                                                        {"capsule", Primitive::capsule, kCapsule},
                                                        {"torus", Primitive::torus, kTorus},
                                                        {"ellipsoid", Primitive::ellipsoid, kBox},
                                                        {"superq", Primitive::superq, kSuperq},
                                                        {"blob", Primitive::blob, kRadius},
                                                        {"halfspace", Primitive::halfspace, kHalfspace},
                                                        {"tube", Primitive::tube, kTube},
                                                        {"beam", Primitive::beam, kTube},
                                                        {"prism", Primitive::prism, kPrism, true},
                                                        {"ca", Primitive::ca, kCa}}};

template <class Table>
constexpr bool inEnumeratorOrder(const Table& table) {
  for (size_t i = 0; i < table.size(); ++i)
    if (static_cast<size_t>(table[i].id) != i) return false;
  return true;
}
static_assert(inEnumeratorOrder(kBuiltins) && inEnumeratorOrder(kPrimitives));

template <class Table>
auto find(const Table& table, std::string_view name) -> decltype(table.data()) {
  for (const auto& info : table)
    if (info.name == name) return &info;
  return nullptr;
}

}  // namespace

std::span<const BuiltinInfo> builtinTable() { return kBuiltins; }
std::span<const PrimitiveInfo> primitiveTable() { return kPrimitives; }
std::span<const ValueRange> branchRangeTable() { return kBranchRanges; }
const BuiltinInfo* findBuiltin(std::string_view name) { return find(kBuiltins, name); }
const PrimitiveInfo* findPrimitive(std::string_view name) { return find(kPrimitives, name); }

bool namesArgument(std::string_view callee, std::string_view word) {
  if (callee == "at") return word == "x" || word == "y" || word == "z";
  const auto has = [&](std::span<const BuiltinParam> params) {
    return std::any_of(params.begin(), params.end(),
                       [&](const BuiltinParam& p) { return p.named_only && p.name == word; });
  };
  if (const PrimitiveInfo* primitive = findPrimitive(callee)) return has(primitive->params);
  if (const BuiltinInfo* builtin = findBuiltin(callee)) return has(builtin->params);
  return false;
}

}  // namespace sgm
