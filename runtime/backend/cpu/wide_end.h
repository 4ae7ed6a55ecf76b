// Undefines the macros of wide.h and shaders/common, so that the next instruction set can define them again. Like
// wide.h, the file has no include guard.

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
