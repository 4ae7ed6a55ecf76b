// Tests walkable floors with shapes whose answers are known, near the origin and far from it.

#include "asked_world.h"

using namespace sgm;

namespace {

WalkableArea walk(const QueryField& field, const IntBox& box, const Walker& walker = {}) {
  const auto area = isWalkable(field, box, walker);
  INFO((area ? "" : area.error().message));
  REQUIRE(area);
  return *area;
}

}  // namespace

TEST_CASE("a floor is walkable where a walker fits: slope, head, width, steps and gaps") {
  const IntBox box{{-6 * 1024, -3 * 1024, -6 * 1024}, {6 * 1024, 5 * 1024, 6 * 1024}};
  const auto areaOf = [&](const std::string& shape, const Walker& walker = {}) {
    return walk(Asked(oneShape(shape)).field, box, walker);
  };
  // This box ends below the upper sides of the ceilings, so that it contains only the floors beneath them.
  const IntBox under{box.lo, {box.hi.x, 2 * 1024, box.hi.z}};
  const double all = 12.0 * 12.0 * kMetre * kMetre;
  const WalkableArea floor = areaOf("box(40m, 2m, 40m);");
  CHECK(floor.walkable);
  CHECK(floor.standing == Approx(all).epsilon(0.05));
  CHECK(floor.largest == floor.standing);
  CHECK(floor.sides == 0b110011);

  // The underside of a slab is no floor. Under a low ceiling, no floor is walkable; under a high one, all of it is.
  CHECK(areaOf("at(0m, 4m, 0m) box(40m, 1m, 40m);").standing > 0);  // the slab's upper side, which lies in the box
  CHECK(areaOf("at(0m, 5m, 0m) box(40m, 1m, 40m);").standing == 0);
  const Asked high_ceiling(oneShape("box(40m, 2m, 40m); at(0m, 3.4m, 0m) box(40m, 1m, 40m);"));
  const Asked low_ceiling(oneShape("box(40m, 2m, 40m); at(0m, 3m, 0m) box(40m, 1m, 40m);"));
  CHECK(walk(high_ceiling.field, under).largest == Approx(all).epsilon(0.05));
  CHECK_FALSE(walk(low_ceiling.field, under).walkable);
  Walker small;
  small.height = 1.2 * kMetre;
  CHECK(walk(low_ceiling.field, under, small).walkable);

  // A slope of 30 degrees is walkable; a slope of 60 degrees is walkable only for a walker that climbs steeper slopes.
  CHECK(areaOf("rot(x, 30deg) box(40m, 2m, 40m);").largest > all / 2);
  CHECK_FALSE(areaOf("rot(x, 60deg) box(40m, 2m, 40m);").walkable);
  Walker climber;
  climber.slope = 0.4;
  CHECK(areaOf("rot(x, 60deg) box(40m, 2m, 40m);", climber).walkable);

  // A walker takes a step of 0.25 m, but not of 1 m: then there are two floors, and neither spans the box.
  const WalkableArea low = areaOf("box(40m, 2m, 40m); at(10m, 0.25m, 0m) box(20m, 2m, 40m);");
  CHECK(low.largest == low.standing);
  CHECK(low.sides == 0b110011);
  const WalkableArea high = areaOf("box(40m, 2m, 40m); at(10m, 1m, 0m) box(20m, 2m, 40m);");
  CHECK(high.largest < 0.6 * high.standing);
  CHECK((high.sides & 3) != 3);

  // A walker passes a door of 2 m, but not a door as narrow as the walker.
  const auto door = [&](double width) {
    const std::string half = std::to_string(6 - width / 2), at = std::to_string(3 + width / 4);
    return areaOf("box(40m, 2m, 40m); at(0m, 2m, " + at + "m) box(0.5m, 3m, " + half + "m); at(0m, 2m, -" + at +
                  "m) box(0.5m, 3m, " + half +
                  "m); at(0m, 2m, 10m) box(0.5m, 3m, 8m); at(0m, 2m, -10m) box(0.5m, 3m, 8m);");
  };
  CHECK((door(2).sides & 3) == 3);
  CHECK((door(0.4).sides & 3) != 3);
  CHECK(door(0.4).walkable);

  // A walker does not step over a gap of 1 m, which is wider than a cell.
  CHECK((areaOf("at(10m, 0m, 0m) box(19m, 2m, 40m); at(-10m, 0m, 0m) box(19m, 2m, 40m);").sides & 3) != 3);
  // There is no floor in an empty box, nor inside solid rock.
  CHECK(areaOf("at(100m, 0m, 0m) sphere(1m);").standing == 0);
  CHECK(areaOf("sphere(30m);").standing == 0);
}

TEST_CASE("the cave's hall is walkable, here and far away") {
  WorldFieldSettings settings = settingsOf(caveText(), 256);
  const Asked asked(settings);
  const auto anchors = asked.world.anchors({{0, 0, 0}, {192 * 1024, 192 * 1024, 192 * 1024}});
  REQUIRE(anchors);
  const Int3 spawn = anchors->front().frame.origin;
  const IntBox box = IntBox{spawn, spawn}.grown(14 * 1024);
  const WalkableArea here = walk(asked.field, box);
  WARN("floor to stand on: " << here.standing / kMetre / kMetre << " square metres, the largest part "
                             << here.largest / kMetre / kMetre);
  CHECK(here.walkable);
  CHECK(here.largest <= here.standing);
  settings.shift = {1 << 30, -(1 << 30), 1 << 30};
  const Asked far(settings);
  const WalkableArea there =
      walk(far.field, {saturatingAdd(box.lo, settings.shift), saturatingAdd(box.hi, settings.shift)});
  CHECK(there.standing == here.standing);
  CHECK(there.largest == here.largest);
  CHECK(there.sides == here.sides);
  // Solid rock.
  CHECK(walk(asked.field, IntBox{{0, 0, 0}, {4096, 4096, 4096}}).standing == 0);
}
