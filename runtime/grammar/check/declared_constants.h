#pragma once
// Checks declarations whose values must be constants: parameter ranges, and the declarations that only the root file
// may have.

#include <cstdint>
#include <optional>
#include <string_view>

#include "grammar/check/types.h"

namespace sgm {

/// Returns the value of an expression outside of rules; nullopt after reporting an error. what: subject of the message,
/// such as "the cell of a layer".
std::optional<double> checkConstant(CheckContext& check, Types& types, ExprId id, Dim dim, std::string_view what);
/// Like checkConstant(), for a length that must be a whole number of units. Returns the number of units.
std::optional<int64_t> checkWholeUnits(CheckContext& check, Types& types, ExprId id, std::string_view what);

/// Checks the parameters of rules, lets and fields: their default values and ranges must be literals.
void checkFormalLiterals(CheckContext& check);
/// Evaluates the ranges of the parameters of rules, lets and fields. Precondition: checkFormalLiterals() found no
/// error.
void checkFormalRanges(CheckContext& check, Types& types);
/// Evaluates the defaults and ranges of the root's `param` declarations.
void checkParams(CheckContext& check, Types& types);

/// Assigns indices in Program::materials to the materials of imported assets.
void numberAssetMaterials(CheckContext& check);
void checkSeed(CheckContext& check, Types& types);
void checkDomain(CheckContext& check, Types& types);
/// Evaluates the constants in `report` and `expect` declarations.
void checkExpectations(CheckContext& check, Symbols& symbols, Types& types);

}  // namespace sgm
