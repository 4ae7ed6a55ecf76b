// One pass over the records of the window, in sweeps: of each kind of op in turn, as many as stand in a row. Included
// in a function where the forms (FORM_*) are defined for whatever flows through the program: values, values with
// gradients, or bounds. They see dst, ra, rb, rc, place and P, and read words by PU.
//
// Software Vulkan runs a loop's body once even where no record is of its kind. So ops that only join values may share a
// loop, which pays where they are short: READ_JOINED reads the operands, the form of the one at hand sets the result,
// WRITE_JOINED stores it. And so what a body reads is zeros then: the words of another kind's record, taken for floats,
// may be denormals, over each of which a processor stumbles for a hundred cycles.

#ifndef FORM_NOISE
#define FORM_NOISE(F) FORM_POSITION(F)
#endif
#define BEGIN(MATCHES)                                                                                    \
    if (MATCHES) do {                                                                                     \
        own = MATCHES ? record : uvec4(0u);                                                               \
        uint slots_word = wordOfRecord(1u);                                                               \
        uint dst = slots_word & 0xFFu, ra = slots_word >> 8 & 0xFFu, rb = slots_word >> 16 & 0xFFu;       \
        uint rc = slots_word >> 24, place = head_word >> 8 & 0xFFu;                                       \
        const uint P = 0u;
#define END(MATCHES)                                                                                      \
        ++record_number;                                                                                  \
        record_at += head_word >> 16;                                                                     \
        record = window[record_at];                                                                       \
        head_word = subgroupShuffle(record.x, 0u);                                                        \
        kind = head_word & 0xFFu;                                                                         \
      } while (MATCHES);
#define SWEEP(NUMBER, BODY)        \
  if (OCCURS(NUMBER)) {            \
    BEGIN(kind == (NUMBER))        \
    const uint number = (NUMBER);  \
    BODY                           \
    END(kind == (NUMBER))          \
  }
#ifdef READ_JOINED
#define JOIN(NUMBER, BODY)                  \
  if (OCCURS(NUMBER) && kind == (NUMBER)) { \
    const uint number = (NUMBER);           \
    BODY                                    \
  }
#else
#define JOIN SWEEP
#endif
#define JOINS (kind - kFirstJoin < kJoins)
  {
    record_at = 0u;
    record = window[0];
    uint head_word = subgroupShuffle(record.x, 0u);
    uint kind = head_word & 0xFFu;
    do {
#include "op_sweep.glsl"
#ifdef READ_JOINED
      BEGIN(JOINS)
      READ_JOINED
#include "op_joins.glsl"
      WRITE_JOINED
      END(JOINS)
#else
#include "op_joins.glsl"
#endif
      SWEEP(kOp_warp, FORM_WARP(none))
      SWEEP(kOpCount, FORM_FOLD)
      SWEEP(kOpCount + 1u, FORM_SMOOTH)
    } while (kind != kEndOfWindow);
  }
#undef BEGIN
#undef END
#undef SWEEP
#undef JOIN
#undef JOINS
