#pragma once
// Parses declarations. Each function parses one kind of declaration, from behind its first word up to and including its
// ';' or block, and adds it to the program.

#include <cstdint>
#include <utility>

#include "grammar/parse/parse_context.h"

namespace sgm::parse {

/// Parses any declaration, chosen by its first word; recovers after errors.
void parseDeclaration(ParseContext& in);

// Defined in parse_declarations.cpp:

/// The hint of the error about a declaration or clause that occurs twice, but is allowed only once.
inline constexpr const char* kRemoveOne = "remove one of them";

/// Appends an item to ModuleSyntax::items, the declarations in source order. Does nothing in panic mode. begin: the
/// span of the declaration's first word; index, sub: see Item.
void addItem(ParseContext& in, ItemKind kind, size_t index, const Span& begin, size_t sub = 0);
/// Appends `value` to the table of its kind, and its item to ModuleSyntax::items. Does nothing in panic mode.
template <typename Table, typename Value>
void declare(ParseContext& in, ItemKind kind, const Span& begin, Table& table, Value&& value) {
  if (in.tokens.hasFailed()) return;
  table.push_back(std::forward<Value>(value));
  addItem(in, kind, table.size() - 1, begin);
}

/// Parses [ ( NAME [= DEFAULT] [in LOW..HIGH], ... ) ].
IdRange parseFormals(ParseContext& in);
/// Parses NAME [FORMALS] = EXPR, behind the word `field`. Returns the index in Program::fields, or kNoId after an
/// error. local: the field is declared within a rule.
uint32_t addField(ParseContext& in, bool local);

void declareImport(ParseContext& in);
void declareUnits(ParseContext& in);
void declareParam(ParseContext& in);
void declareSeed(ParseContext& in);
void declareLet(ParseContext& in);
void declareField(ParseContext& in);
void declareStart(ParseContext& in);

// Defined in parse_domain.cpp:

void declareDomain(ParseContext& in);
void declareLayer(ParseContext& in);

// Defined in parse_rules.cpp and parse_overrides.cpp:

void declareRule(ParseContext& in);
void declareMorphicRule(ParseContext& in);
void declareOverride(ParseContext& in);

// Defined in parse_expectations.cpp:

void declareReport(ParseContext& in);
void declareExpectation(ParseContext& in);

}  // namespace sgm::parse
