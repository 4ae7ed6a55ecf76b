#include "grammar/identity/hash_meaning.h"

#include <bit>

#include "base/hash.h"
#include "grammar/syntax/declared_members.h"

namespace sgm {
namespace {

/// Hashes the members of nodes in the order in which they are listed.
class MeaningHasher : public MemberVisitor {
 public:
  explicit MeaningHasher(const Program& program) : program_(program) {}

  void value(uint64_t word) { hash_ = hashCombine(hash_, word); }
  void count(uint32_t number) { value(number); }
  void name(NameId id) {
    value(id != kNoId);
    if (id != kNoId) value(hashText(program_.text(id)));
  }
  void literal(double number, const Type& type) {
    value(std::bit_cast<uint64_t>(number));
    for (const int part : {static_cast<int>(type.kind), int{type.dim.length}, int{type.dim.angle}})
      value(static_cast<uint64_t>(part));
  }
  void expr(ExprId id) {
    value(id != kNoId);
    if (id != kNoId) visitMembers(program_, program_.expr(id), *this);
  }
  void stmt(StmtId id) {
    value(id != kNoId);
    if (id != kNoId) visitMembers(program_, program_.stmt(id), *this);
  }

  uint64_t hash() const { return hash_; }

 private:
  const Program& program_;
  uint64_t hash_ = 0;
};

}  // namespace

uint64_t hashMeaning(const Program& program, const ModuleSyntax& syntax) {
  MeaningHasher hasher(program);
  for (const Item& item : syntax.items) {
    // Neither report/expect nor units changes what is derived.
    if (item.kind == ItemKind::expectation || item.kind == ItemKind::units) continue;
    visitMembers(program, Declaration{syntax, item}, hasher);
  }
  return hasher.hash();
}

uint64_t hashMeaning(const Program& program, std::span<const ModuleSyntax> files) {
  uint64_t hash = hashCombine(hashText("sgm"), kMeaningVersion);
  for (const ModuleSyntax& file : files) hash = hashCombine(hash, hashMeaning(program, file));
  for (const Asset& asset : program.assets) hash = hashCombine(hash, asset.hash);
  return hash;
}

}  // namespace sgm
