#pragma once
// The stable code of every diagnostic. A test for each code checks the exact line and column of an example.

#include <string_view>

namespace sgm::codes {

// The text
inline constexpr std::string_view kBadCharacter = "bad-character";
inline constexpr std::string_view kBadText = "bad-text";
inline constexpr std::string_view kBadNumber = "bad-number";
inline constexpr std::string_view kNumberRange = "number-range";
inline constexpr std::string_view kUnknownUnit = "unknown-unit";
inline constexpr std::string_view kTooLarge = "too-large";
inline constexpr std::string_view kTooDeep = "too-deep";
inline constexpr std::string_view kTooManyErrors = "too-many-errors";
// The syntax
inline constexpr std::string_view kSyntax = "syntax";
inline constexpr std::string_view kNotAvailable = "not-available";
inline constexpr std::string_view kReservedWord = "reserved-word";
inline constexpr std::string_view kVersion = "version";
inline constexpr std::string_view kDuplicate = "duplicate";
// Imports
inline constexpr std::string_view kImportPath = "import-path";
inline constexpr std::string_view kImportMissing = "import-missing";
inline constexpr std::string_view kImportCycle = "import-cycle";
inline constexpr std::string_view kImportLimit = "import-limit";
inline constexpr std::string_view kImportContent = "import-content";
inline constexpr std::string_view kAsset = "asset";
// Codes of errors in names and arguments
inline constexpr std::string_view kUnknownName = "unknown-name";
inline constexpr std::string_view kUnknownMember = "unknown-member";
inline constexpr std::string_view kArgumentCount = "argument-count";
inline constexpr std::string_view kArgumentName = "argument-name";
inline constexpr std::string_view kParameterNames = "parameter-names";
inline constexpr std::string_view kWrongUse = "wrong-use";
inline constexpr std::string_view kShadowsBuiltin = "shadows-builtin";
inline constexpr std::string_view kUnusedRule = "unused-rule";
inline constexpr std::string_view kUnusedValue = "unused-value";
// Codes of errors in types and stages
inline constexpr std::string_view kUnitMismatch = "unit-mismatch";
inline constexpr std::string_view kTypeMismatch = "type-mismatch";
inline constexpr std::string_view kStage = "stage";
inline constexpr std::string_view kRandKey = "rand-key";
inline constexpr std::string_view kNotConstant = "not-constant";
inline constexpr std::string_view kValueRange = "value-range";
inline constexpr std::string_view kParamRange = "param-range";
inline constexpr std::string_view kArgumentRange = "argument-range";
inline constexpr std::string_view kDivideByZero = "divide-by-zero";
// Structure
inline constexpr std::string_view kRecursiveValue = "recursive-value";
inline constexpr std::string_view kUnboundedRecursion = "unbounded-recursion";
inline constexpr std::string_view kNoStart = "no-start";
inline constexpr std::string_view kDomain = "domain";
inline constexpr std::string_view kLayerCycle = "layer-cycle";
inline constexpr std::string_view kLayerUses = "layer-uses";
inline constexpr std::string_view kWholeUnits = "whole-units";
inline constexpr std::string_view kReachTooLarge = "reach-too-large";
inline constexpr std::string_view kReach = "reach";
inline constexpr std::string_view kReachMaybe = "reach-maybe";
inline constexpr std::string_view kMorphDisjoint = "morph-disjoint";
inline constexpr std::string_view kGuards = "guards";
inline constexpr std::string_view kIdleHead = "idle-head";
inline constexpr std::string_view kIdleOverride = "idle-override";
inline constexpr std::string_view kIdleCut = "idle-cut";
inline constexpr std::string_view kFlatScope = "flat-scope";
inline constexpr std::string_view kNearName = "near-name";

}  // namespace sgm::codes
