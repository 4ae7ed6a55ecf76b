#pragma once

#include <deque>
#include <string>
#include <vector>

#include "godot/variant.h"
#include "world/lifetime.h"

namespace sgm_godot {

/// The last error of a world, and the signals that wait until the work that they report is done: a handler of a signal
/// may end the world or start another. Main thread.
class Messages {
 public:
  /// `owner`: the object whose signals they are.
  explicit Messages(Object owner) : owner_(owner) {}

  /// Empty if there is none.
  const std::string& error() const { return error_; }
  void clearError() { error_.clear(); }
  /// Keeps the error and announces `failed`.
  void fail(const std::string& message);

  /// `signal` must be a literal. At most one argument.
  template <class... Arguments>
  void announce(const char* signal, const Arguments&... arguments) {
    static_assert(sizeof...(Arguments) <= 1);
    announced_.push_back({signal, std::vector<Variant>{Variant(arguments)...}});
  }
  /// Emits the announced signals. A call does this last, since the world may not exist afterwards.
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
