#include "sgm/sgm.h"

// Converts the value of a macro to a string literal.
#define SGM_TEXT_OF(x) #x
#define SGM_TEXT(x) SGM_TEXT_OF(x)
#define SGM_VERSION_TEXT SGM_TEXT(SGM_VERSION_MAJOR) "." SGM_TEXT(SGM_VERSION_MINOR) "." SGM_TEXT(SGM_VERSION_PATCH)

#if defined(__clang__)
#define SGM_COMPILER_TEXT "clang " SGM_TEXT(__clang_major__) "." SGM_TEXT(__clang_minor__)
#elif defined(__GNUC__)
#define SGM_COMPILER_TEXT "gcc " SGM_TEXT(__GNUC__) "." SGM_TEXT(__GNUC_MINOR__)
#else
#define SGM_COMPILER_TEXT "unknown compiler"
#endif

#if defined(__x86_64__)
#define SGM_MACHINE_TEXT "x86-64"
#elif defined(__aarch64__)
#define SGM_MACHINE_TEXT "aarch64"
#else
#define SGM_MACHINE_TEXT "unknown machine"
#endif

#if defined(NDEBUG)
#define SGM_CHECKS_TEXT "no assertions"
#else
#define SGM_CHECKS_TEXT "assertions"
#endif

uint32_t sgm_version(void) { return SGM_API_VERSION; }

const char* sgm_version_string(void) { return SGM_VERSION_TEXT; }

const char* sgm_build_info(void) {
  return "sgm " SGM_VERSION_TEXT ", " SGM_COMPILER_TEXT ", " SGM_MACHINE_TEXT ", vectors: " SGM_VECTORS_TEXT
         ", backends: " SGM_BACKENDS_TEXT ", " SGM_CHECKS_TEXT;
}
