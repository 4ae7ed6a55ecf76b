// The layout once more, as C++20.
#include "cuda_layout.c"
