#pragma once
// Helpers for C functions that are implemented in C++: checks of arguments, and a guard that catches all exceptions.

#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.h"
#include "sgm/sgm.h"

namespace sgm::api {

/// Writes code, position and message into `error` (which may be null); a long message is cut at a whole UTF-8
/// character. Returns code.
sgm_result fail(sgm_error* error, sgm_result code, std::string_view message, int line = 0, int column = 0) noexcept;

/// Converts an internal error code to the code of the C interface.
sgm_result resultOf(Code code) noexcept;

inline sgm_result fail(sgm_error* error, const Error& e) noexcept {
  return fail(error, resultOf(e.code), e.message, e.line, e.column);
}

/// Checks a descriptor struct of the caller. Returns SGM_OK, or an error if it is null, has the size of another
/// version, or has an extension in `next`. name: the parameter's name, for the message.
template <class Desc>
sgm_result checkDesc(sgm_error* error, const Desc* desc, const char* name) {
  if (desc == nullptr) return fail(error, SGM_ERR_INVALID_ARGUMENT, std::string(name) + " is NULL");
  if (desc->struct_size != sizeof(Desc))
    return fail(error, SGM_ERR_STRUCT_SIZE,
                std::string(name) + ".struct_size is " + std::to_string(desc->struct_size) + ", not " +
                    std::to_string(sizeof(Desc)) + ": start from the _INIT macro of this library's header");
  if (desc->next != nullptr)
    return fail(error, SGM_ERR_UNSUPPORTED,
                std::string(name) + ".next points to an extension that this version does not support");
  return SGM_OK;
}

inline sgm_result nullArgument(sgm_error* error, const char* name) {
  return fail(error, SGM_ERR_INVALID_ARGUMENT, std::string(name) + " is NULL");
}

/// Checks the stride of an array. A stride of 0 becomes the element's size. Returns SGM_OK, or an error if the stride
/// is invalid.
template <class Element>
sgm_result checkStride(sgm_error* error, size_t& stride, const char* name) {
  if (stride == 0) stride = sizeof(Element);
  if (stride >= sizeof(Element) && stride % alignof(Element) == 0) return SGM_OK;
  return fail(error, SGM_ERR_INVALID_ARGUMENT,
              std::string(name) + " is below " + std::to_string(sizeof(Element)) + " or not a multiple of " +
                  std::to_string(alignof(Element)));
}

/// Runs the body of a C function, and converts C++ exceptions to result codes, because no exception may reach C code.
template <class Body>
sgm_result guarded(sgm_error* error, Body&& body) noexcept {
  try {
    return std::forward<Body>(body)();
  } catch (const std::bad_alloc&) {
    return fail(error, SGM_ERR_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& e) {
    return fail(error, SGM_ERR_INTERNAL, e.what());
  } catch (...) {
    return fail(error, SGM_ERR_INTERNAL, "an unknown exception was thrown");
  }
}

}  // namespace sgm::api
