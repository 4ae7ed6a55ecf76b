// One pass over the records of the window, in sweeps: of each kind of op in turn, as many as stand in a row. Included
// in a function where the forms (FORM_*) are defined for whatever flows through the program: values, values with
// gradients, or bounds. They see dst, ra, rb, rc, place and P, and read words by PU.

#define SWEEP(NUMBER, BODY)                                                                               \
  if (OCCURS(NUMBER)) {                                                                                   \
    if (kind == (NUMBER)) do {                                                                            \
        uint slots_word = wordOfRecord(1u);                                                               \
        uint dst = slots_word & 0xFFu, ra = slots_word >> 8 & 0xFFu, rb = slots_word >> 16 & 0xFFu;       \
        uint rc = slots_word >> 24, place = head_word >> 8 & 0xFFu;                                       \
        const uint P = 0u;                                                                                \
        const uint number = (NUMBER);                                                                     \
        BODY                                                                                              \
        ++record_number;                                                                                  \
        record_at += head_word >> 16;                                                                     \
        record = window[record_at];                                                                       \
        head_word = wordOfRecord(0u);                                                                     \
        kind = head_word & 0xFFu;                                                                         \
      } while (kind == (NUMBER));                                                                         \
  }
  {
    record_at = 0u;
    record = window[0];
    uint head_word = wordOfRecord(0u);
    uint kind = head_word & 0xFFu;
    do {
#include "op_sweep.glsl"
      SWEEP(kOpCount, FORM_FOLD)
      SWEEP(kOpCount + 1u, FORM_SMOOTH)
    } while (kind != kEndOfWindow);
  }
#undef SWEEP
