#pragma once

#include "grammar.h"
#include "placement.h"
#include "plugin.h"
#include "settings.h"
#include "world/messages.h"

namespace sgm_godot {

/// The engine's node of a world, the settings that the game has chosen for it, and its messages. All parts of a world
/// share this object. Main thread only.
struct WorldNode {
  Plugin& plugin;
  Object object;
  Messages messages{object};
  Settings settings = {};
  Variant grammar = {};  // an SgmGrammar, or nil
  bool in_tree = false;

  /// Calls a method of the engine's node.
  template <class... Arguments>
  Variant call(std::string_view method, const Arguments&... arguments) const {
    return Variant(object).call(method, arguments...);
  }
  Placement placement() const {
    return {in_tree ? call("get_global_transform").to<Transform>() : Transform(), settings.origin};
  }
  /// The compiled grammar; null if there is none.
  GrammarOwner compiled() const {
    const auto* resource = instanceOf<Grammar>(grammar);
    return resource != nullptr ? resource->compiled() : nullptr;
  }
};

}  // namespace sgm_godot
