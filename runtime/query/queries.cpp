#include "query/queries.h"

#include "world/world_field.h"

namespace sgm {

QueryField queryField(const WorldField& world) {
  return {[&world](const IntBox& box) { return world.compile(box, 0); }, world.settings().finest_cell, world.memory(),
          !world.settings().hosts.empty()};
}

}  // namespace sgm
