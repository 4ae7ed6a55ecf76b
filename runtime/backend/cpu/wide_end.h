// Undefines the macros of wide.h and shaders/common for the next instruction set. No guard, as in wide.h.

#undef FN
#undef PRECISE
#undef PI
#undef PU
#undef PF
#undef QF
#undef QI
#undef RF
#undef RI
#undef SGM_VECTOR_FORMS
#undef SGM_LANE_TABLES
#undef SGM_ROWS
#undef SGM_WIDE
