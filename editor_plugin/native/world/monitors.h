#pragma once

#include <string>
#include <vector>

#include "godot/variant.h"

namespace sgm_godot {

/// The figures of a world that the engine's debugger plots. Main thread.
class Monitors {
 public:
  /// Adds them for a node, whose method `_monitor` returns the figures.
  void add(Object node);
  void remove();

 private:
  std::vector<std::string> ids_;
};

}  // namespace sgm_godot
