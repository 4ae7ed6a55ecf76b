#pragma once
// Errors are values: every operation that can fail because of bad input or missing resources returns a Result.

#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace sgm {

enum class Code {
  invalid_argument,  ///< the call violated the function's contract
  range,             ///< a value beyond the integer grid: a position outside the world, a cell too large
  bad_input,         ///< text or data from outside is invalid; Error::line and column give the place
  limit,             ///< a limit (on count, depth, memory, time or threads) was reached
  out_of_memory,
  io,           ///< a file could not be read or written
  unsupported,  ///< this machine or build lacks the backend, device or feature
  cancelled,
  busy,         ///< the resource is in use, so the operation is not possible now
  device_lost,  ///< the GPU has failed; objects created on it are no longer usable
};

/// An error code with one message that states the problem and its remedy. line and column count from 1; they are 0 if
/// the error has no place in a text.
struct Error {
  Code code = Code::invalid_argument;
  std::string message;
  int line = 0;
  int column = 0;
};

/// Either a value or an Error. Reading the value of an error, or the error of a value, is a bug in the caller and
/// aborts.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  T& operator*() & { return *there(std::get_if<0>(&state_)); }
  const T& operator*() const& { return *there(std::get_if<0>(&state_)); }
  T&& operator*() && { return std::move(*there(std::get_if<0>(&state_))); }
  T* operator->() { return there(std::get_if<0>(&state_)); }
  const T* operator->() const { return there(std::get_if<0>(&state_)); }
  const Error& error() const { return *there(std::get_if<1>(&state_)); }

 private:
  template <class P>
  static P* there(P* p) {
    if (!p) std::abort();
    return p;
  }

  std::variant<T, Error> state_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  explicit operator bool() const { return !error_; }
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace sgm
