#pragma once

#include <deque>
#include <string>
#include <vector>

#include "godot/variant.h"
#include "world/lifetime.h"

namespace sgm_godot {

/// The last error of a world, and its queued signals. A signal is emitted only when the work that it reports is done,
/// since its handler may end the world or start another one. Main thread only.
class Messages {
 public:
  /// `owner`: the object that emits the signals.
  explicit Messages(Object owner) : owner_(owner) {}

  /// Returns the last error; empty if there is none.
  const std::string& error() const { return error_; }
  void clearError() { error_.clear(); }
  /// Stores the error, and queues the signal `failed`.
  void fail(const std::string& message);

  /// Queues a signal for emit(). `signal` must be a string literal. A signal has at most one argument.
  template <class... Arguments>
  void announce(const char* signal, const Arguments&... arguments) {
    static_assert(sizeof...(Arguments) <= 1);
    announced_.push_back({signal, std::vector<Variant>{Variant(arguments)...}});
  }
  /// Emits the queued signals. A function calls this as its last step, since a handler may destroy the world.
  void emit();

 private:
  struct Signal {
    const char* name;
    std::vector<Variant> arguments;
  };
  Object owner_;
  std::string error_;
  std::deque<Signal> announced_;
  Lifetime lifetime_;
};

}  // namespace sgm_godot
