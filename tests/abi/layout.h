/*
 * Macros for files that check the binary layout of the public headers at compile time. Each of these files is compiled
 * as C99 and as C++20.
 *   CHECK(name, truth)           does not compile if truth is false
 *   SIZE(type, bytes)            checks the size of a struct
 *   PLACE(type, field, bytes)    checks the offset of a field
 *   INITS(name) { ... }          defines the function name_c in C, and name_cpp in C++; it returns 1 if all is right
 */
#pragma once

#if defined(__cplusplus)
#define CHECK(name, truth) static_assert(truth, #name)
#define INITS(name)                \
  extern "C" int name##_cpp(void); \
  extern "C" int name##_cpp(void)
#else
#define CHECK(name, truth) typedef char check_##name[(truth) ? 1 : -1]
#define INITS(name)   \
  int name##_c(void); \
  int name##_c(void)
#endif
#define SIZE(type, bytes) CHECK(sizeof_##type, sizeof(type) == (bytes))
#define PLACE(type, field, bytes) CHECK(offsetof_##type##_##field, offsetof(type, field) == (bytes))
