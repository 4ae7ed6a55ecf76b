// Compiles cuda_layout.c as C++20.
#include "cuda_layout.c"
