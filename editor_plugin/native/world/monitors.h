#pragma once

#include <string>
#include <vector>

#include "godot/variant.h"

namespace sgm_godot {

/// Registers the figures of a world that the engine's debugger plots. Main thread only.
class Monitors {
 public:
  /// Registers the figures of a world node. The node's method `_monitor` returns their values.
  void add(Object node);
  void remove();

 private:
  std::vector<std::string> ids_;
};

}  // namespace sgm_godot
