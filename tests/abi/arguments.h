#pragma once
// Helpers that check how functions of the C interface reject invalid arguments.

#include "fixture.h"

/// A runtime with a field that contains one ball.
struct World {
  RuntimeOwner runtime = makeRuntime();
  GrammarOwner grammar = compile(runtime.get(), kBall);
  FieldOwner field = makeField(runtime.get(), grammar.get());
};

inline sgm_chain extension = {sizeof(sgm_chain), 1, nullptr};

/// Checks that `call` rejects a struct of a wrong size, a struct with an unknown extension, and NULL.
template <class Desc, class Call>
void checkStruct(Desc good, Call&& call) {
  for (const uint32_t size : {0u, 4u, good.struct_size - 1, good.struct_size + 8, 0xFFFFFFFFu}) {
    Desc bad = good;
    bad.struct_size = size;
    CHECK(call(&bad) == SGM_ERR_STRUCT_SIZE);
  }
  Desc extended = good;
  extended.next = &extension;
  CHECK(call(&extended) == SGM_ERR_UNSUPPORTED);
  CHECK(call(static_cast<Desc*>(nullptr)) == SGM_ERR_INVALID_ARGUMENT);
}
