#pragma once
// Includes Catch2's header, which versions 2 and 3 keep in different places.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#define CATCH_CONFIG_FAST_COMPILE  // makes compilation faster; a check that throws an exception ends its test case
#include <catch2/catch.hpp>
#endif
