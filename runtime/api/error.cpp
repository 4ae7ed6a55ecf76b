#include <algorithm>
#include <cstring>

#include "api/barrier.h"

namespace sgm::api {

sgm_result fail(sgm_error* error, sgm_result code, std::string_view message, int line, int column) noexcept {
  if (error == nullptr) return code;
  error->code = code;
  error->line = line;
  error->column = column;
  size_t length = std::min(message.size(), sizeof error->message - 1);
  if (length < message.size()) {
    // The message must not be cut inside a character: in UTF-8, bytes of the form 10xxxxxx continue a character.
    while (length > 0 && (static_cast<unsigned char>(message[length]) & 0xC0u) == 0x80u) --length;
  }
  std::memcpy(error->message, message.data(), length);
  error->message[length] = '\0';
  return code;
}

sgm_result resultOf(Code code) noexcept {
  switch (code) {
    case Code::invalid_argument:
      return SGM_ERR_INVALID_ARGUMENT;
    case Code::range:
      return SGM_ERR_RANGE;
    case Code::bad_input:
      return SGM_ERR_GRAMMAR;
    case Code::limit:
      return SGM_ERR_LIMIT;
    case Code::out_of_memory:
      return SGM_ERR_OUT_OF_MEMORY;
    case Code::io:
      return SGM_ERR_IO;
    case Code::unsupported:
      return SGM_ERR_UNSUPPORTED;
    case Code::busy:
      return SGM_ERR_BUSY;
    case Code::device_lost:
      return SGM_ERR_DEVICE_LOST;
    case Code::cancelled:
      return SGM_ERR_CANCELLED;
  }
  return SGM_ERR_INTERNAL;
}

}  // namespace sgm::api

const char* sgm_result_name(sgm_result result) {
  switch (result) {
    case SGM_OK:
      return "SGM_OK";
    case SGM_INCOMPLETE:
      return "SGM_INCOMPLETE";
    case SGM_ERR_INVALID_ARGUMENT:
      return "SGM_ERR_INVALID_ARGUMENT";
    case SGM_ERR_STRUCT_SIZE:
      return "SGM_ERR_STRUCT_SIZE";
    case SGM_ERR_VERSION:
      return "SGM_ERR_VERSION";
    case SGM_ERR_OUT_OF_MEMORY:
      return "SGM_ERR_OUT_OF_MEMORY";
    case SGM_ERR_GRAMMAR:
      return "SGM_ERR_GRAMMAR";
    case SGM_ERR_LIMIT:
      return "SGM_ERR_LIMIT";
    case SGM_ERR_RANGE:
      return "SGM_ERR_RANGE";
    case SGM_ERR_IO:
      return "SGM_ERR_IO";
    case SGM_ERR_UNSUPPORTED:
      return "SGM_ERR_UNSUPPORTED";
    case SGM_ERR_CANCELLED:
      return "SGM_ERR_CANCELLED";
    case SGM_ERR_BUSY:
      return "SGM_ERR_BUSY";
    case SGM_ERR_NOT_FOUND:
      return "SGM_ERR_NOT_FOUND";
    case SGM_ERR_INTERNAL:
      return "SGM_ERR_INTERNAL";
    case SGM_ERR_DATA:
      return "SGM_ERR_DATA";
    case SGM_ERR_DEVICE_LOST:
      return "SGM_ERR_DEVICE_LOST";
    case SGM_RESULT_FORCE_32_BIT:
      break;
  }
  return "unknown";
}
