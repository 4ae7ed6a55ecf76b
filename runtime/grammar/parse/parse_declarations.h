#pragma once
// Declarations. Each function parses one kind behind its first word, with its ';' or block, and adds it.

#include <cstdint>
#include <utility>

#include "grammar/parse/parse_context.h"

namespace sgm::parse {

/// Parses any declaration, by its first word; recovers after errors.
void parseDeclaration(ParseContext& in);

// parse_declarations.cpp

/// The advice on a second declaration or clause where there may be one.
inline constexpr const char* kRemoveOne = "remove one of them";

/// Appends an item to the list of declarations in source order, unless the stream panics. begin: the span of the
/// declaration's first word; index and sub: see Item.
void addItem(ParseContext& in, ItemKind kind, size_t index, const Span& begin, size_t sub = 0);
/// The same, after it has added `value` to the table of its kind.
template <typename Table, typename Value>
void declare(ParseContext& in, ItemKind kind, const Span& begin, Table& table, Value&& value) {
  if (in.tokens.hasFailed()) return;
  table.push_back(std::forward<Value>(value));
  addItem(in, kind, table.size() - 1, begin);
}

/// [ ( NAME [= DEFAULT] [in LOW..HIGH], ... ) ]
IdRange parseFormals(ParseContext& in);
/// NAME [FORMALS] = EXPR; behind `field`. Returns its index in Program::fields, or kNoId after an error. local: in a
/// rule.
uint32_t addField(ParseContext& in, bool local);

void declareImport(ParseContext& in);
void declareUnits(ParseContext& in);
void declareParam(ParseContext& in);
void declareSeed(ParseContext& in);
void declareLet(ParseContext& in);
void declareField(ParseContext& in);
void declareStart(ParseContext& in);

// parse_domain.cpp

void declareDomain(ParseContext& in);
void declareLayer(ParseContext& in);

// parse_rules.cpp, parse_overrides.cpp

void declareRule(ParseContext& in);
void declareMorphicRule(ParseContext& in);
void declareOverride(ParseContext& in);

// parse_expectations.cpp

void declareReport(ParseContext& in);
void declareExpectation(ParseContext& in);

}  // namespace sgm::parse
