#pragma once
// Files that version 0.2 has written (tests/unit/data/version_0_2), and their world. These commands of `sgm` 0.2.0 made
// them:
//
//   OPTIONS="hollow.sgm --seed 5 --set radius=2.75m --cell 1"
//   sgm bake $OPTIONS --region 0,0,0:8,8,8 --levels 0..1 --out store
//   sgm fly $OPTIONS --journal edits.journal --edits 4 --path path.json --speed 1 --frames 300

#include <filesystem>

#include "world/world_field.h"
#include "world_support.h"

namespace sgm {

inline std::filesystem::path formerFile(const std::string& name) {
  return std::filesystem::path(SGM_UNIT_DATA) / "version_0_2" / name;
}

/// Returns the settings of the world of version 0.2. change: a text that replaces `box(2m` in the grammar.
inline WorldFieldSettings formerWorld(const std::string& change = "box(2m") {
  WorldFieldSettings settings =
      settingsOf(replaced(textOfFile(formerFile("hollow.sgm").string()), "box(2m", change), kUnitsPerMetre, 5);
  settings.parameters.values = {2.75};
  return settings;
}

}  // namespace sgm
