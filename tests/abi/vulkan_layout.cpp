// Compiles vulkan_layout.c as C++20.
#include "vulkan_layout.c"
