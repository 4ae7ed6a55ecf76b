// Processes the records in the window once, in sweeps. A sweep goes through the kinds of op in turn; for each kind, a
// loop processes all successive records of that kind. This file is included in a function, for which the macros FORM_*
// are defined: for values, for values with gradients, or for bounds. These macros may use dst, ra, rb, rc, place and P,
// and read parameter words by PU.
//
// Software Vulkan runs the body of such a loop once even if no record is of its kind. Ops that only combine values are
// short, so to save time they share one loop: READ_JOINED reads the operands, the form of the current op sets the
// result, WRITE_JOINED stores it. A body that runs without a record of its kind reads zeroes, because the words of
// another record could be denormals when read as floats, and each denormal costs a processor a hundred cycles.

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
