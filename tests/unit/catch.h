#pragma once
// Catch2 2 and 3 keep their headers in different places; tests include this.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#define CATCH_CONFIG_FAST_COMPILE  // a check that throws ends its test case, which is good enough here
#include <catch2/catch.hpp>
#endif
