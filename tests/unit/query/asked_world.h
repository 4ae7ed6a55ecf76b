#pragma once
// Worlds for tests of queries.

#include "query/queries.h"
#include "world/world_support.h"

namespace sgm {

inline constexpr double kMetre = 1024;

/// A world with the field that queries use.
struct Asked {
  WorldField world;
  QueryField field;

  explicit Asked(const WorldFieldSettings& settings)
      : world(settings, std::pmr::get_default_resource()), field(queryField(world)) {}
  Asked(const Asked&) = delete;
};

inline WorldFieldSettings oneShape(const std::string& shape, int32_t cell = 256, Int3 shift = {}) {
  WorldFieldSettings s = settingsOf("sgm 1; units m;\nstart Main;\nrule Main { " + shape + " }\n", cell);
  s.shift = shift;
  return s;
}

}  // namespace sgm
