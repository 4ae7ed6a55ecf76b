// The layout once more, as C++20.
#include "vulkan_layout.c"
