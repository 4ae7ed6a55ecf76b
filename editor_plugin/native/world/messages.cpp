#include "world/messages.h"

#include <utility>

namespace sgm_godot {

void Messages::fail(const std::string& message) {
  error_ = message;
  announce("failed", message);
}

void Messages::emit() {
  const std::shared_ptr<const bool> exists = lifetime_.watch();
  while (*exists && !announced_.empty()) {
    const Signal signal = std::move(announced_.front());
    announced_.pop_front();
    const Variant owner(owner_), name{Name(signal.name)};
    if (signal.arguments.empty()) {
      owner.call("emit_signal", name);
    } else {
      owner.call("emit_signal", name, signal.arguments.front());
    }
  }
}

}  // namespace sgm_godot
