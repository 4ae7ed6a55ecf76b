// The layout once more, as C++20.
#include "layout.c"
