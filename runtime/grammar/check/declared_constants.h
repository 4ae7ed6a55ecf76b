#pragma once
// Declarations whose values are constants: ranges of parameters, and what only the root file has.

#include <cstdint>
#include <optional>
#include <string_view>

#include "grammar/check/types.h"

namespace sgm {

/// The value of an expression outside of rules; nullopt after an error. what: "the cell of a layer".
std::optional<double> checkConstant(CheckContext& check, Types& types, ExprId id, Dim dim, std::string_view what);
/// The same for a length that is a whole number of units.
std::optional<int64_t> checkWholeUnits(CheckContext& check, Types& types, ExprId id, std::string_view what);

/// Requires that the defaults and ranges of the formals of rules, lets and fields are literals.
void checkFormalLiterals(CheckContext& check);
/// Evaluates the ranges of the formals of rules, lets and fields. Precondition: checkFormalLiterals() found no error.
void checkFormalRanges(CheckContext& check, Types& types);
/// Evaluates the defaults and ranges of the root's parameters.
void checkParams(CheckContext& check, Types& types);

/// Gives the materials of assets their numbers in the program.
void numberAssetMaterials(CheckContext& check);
void checkSeed(CheckContext& check, Types& types);
void checkDomain(CheckContext& check, Types& types);
/// Evaluates the numbers of the statements `report` and `expect`.
void checkExpectations(CheckContext& check, Symbols& symbols, Types& types);

}  // namespace sgm
