// Tests the sampled columns of a cave whose measures are known.

#include "tools/survey/sheet.h"
#include "world/world_support.h"

using namespace sgm;
using namespace sgm::survey;

namespace {

// Two rooms one above the other, the upper one with a pool along one side.
constexpr const char* kRooms = R"(sgm 1;
units m;
domain infinite axes xz solid limestone;
layer rooms cell 40m reach 1m { start Rooms; }
layer pool cell 40m reach 1m { start Pool; }
rule Rooms {
  cut {
    at(20m, 6m, 20m) box(20m, 8m, 12m);
    at(20m, -8m, 20m) box(8m, 6m, 30m);
  }
}
rule Pool { at(26m, 2.5m, 20m) { box(4m, 1m, 10m); mat water; } }
)";

const IntBox kRegion{{4096, -16384, 4096}, {36864, 16384, 36864}};

Columns sampled(const WorldField& world) {
  const auto jobs = *makeThreadPool(2);
  Result<Columns> columns = sampleColumns(world, kRegion, 0, *jobs);
  REQUIRE(columns);
  return std::move(*columns);
}

bool hasMark(const Drawing& drawing, std::string_view name) {
  return std::ranges::any_of(drawing.marks, [&](const Mark& mark) { return mark.name == name; });
}

}  // namespace

TEST_CASE("columns have the rooms that they pass through", "[survey]") {
  const WorldField world(settingsOf(kRooms, 512), std::pmr::new_delete_resource());
  const Columns columns = sampled(world);
  CHECK(columns.subject == Subject::hollow);
  CHECK(columns.step == 512);
  const auto columnAt = [&](double x, double z) {
    return columns.widest.index(static_cast<int>((x - 4) * 2), static_cast<int>((z - 4) * 2));
  };
  const size_t both = columnAt(20, 21);
  REQUIRE(columns.first[both + 1] - columns.first[both] == 2);
  const Stretch &lower = columns.stretches[columns.first[both]], &upper = columns.stretches[columns.first[both] + 1];
  CHECK(lower.bottom == Approx(-11).margin(0.02));
  CHECK(lower.top == Approx(-5).margin(0.02));
  CHECK(upper.bottom == Approx(2).margin(0.02));
  CHECK(upper.top == Approx(10).margin(0.02));
  CHECK(columns.shownAt(both) == &upper);
  CHECK(columns.under.values[both] > 0);
  CHECK(columns.shown[columnAt(35, 34)] == kNone);
  // The lower room is shown only where there is no room above it.
  CHECK(columns.shownAt(columnAt(20, 32))->top == Approx(-5).margin(0.02));
  CHECK_FALSE(columns.under.values[columnAt(20, 32)] > 0);
  const MaterialSigns signs = signsFor(*world.settings().program);
  CHECK(signs.isWater(columns.floor_label[columnAt(26, 21)]));
  CHECK_FALSE(signs.isWater(columns.floor_label[both]));
  CHECK(columns.shownAt(columnAt(26, 21))->bottom == Approx(3).margin(0.02));
}

TEST_CASE("a sheet has walls, water, what lies below, and the cut", "[survey]") {
  const WorldField world(settingsOf(kRooms, 512), std::pmr::new_delete_resource());
  const Columns columns = sampled(world);
  const auto jobs = *makeThreadPool(2);
  const CutLine line = longestCut(columns);
  CHECK(line.length() == Approx(32));
  const Result<Slice> slice = sampleSlice(world, columns, 0, {-10, 20, 50, 20}, *jobs);
  REQUIRE(slice);
  CHECK(slice->line.x0 == Approx(4));
  CHECK(slice->line.x1 == Approx(36));
  SheetRequest request;
  request.width = 800;
  request.height = 600;
  request.title = "rooms.sgm";
  SheetFigures figures;
  const Drawing drawing = drawSheet(columns, &*slice, signsFor(*world.settings().program), request, figures);
  for (const char* name : {"wall", "water", "shore", "under", "cut", "rock", "scale", "north", "room", "beyond"}) {
    INFO(name);
    CHECK(hasMark(drawing, name));
  }
  // The area of the plan: the upper room, and the part of the lower room that extends beyond the upper one.
  CHECK(figures.plan.area == Approx(20 * 12 + 8 * 18).epsilon(0.03));
  CHECK(figures.plan.lowest == Approx(-11).margin(0.1));
  CHECK(figures.plan.leads == 0);
  CHECK(figures.plan.water == std::set<double>{3.0});
  // The area of the section is that of both rooms, without the pool.
  CHECK(figures.section.area == Approx(20 * 8 - 4 + 8 * 6).epsilon(0.1));
  for (const Mark& mark : drawing.marks)
    for (const Line& one : mark.lines)
      for (const Point& p : one) CHECK((p.x > -20 && p.y > -20 && p.x < 820 && p.y < 620));
}

TEST_CASE("a line must meet the region, and be one", "[survey]") {
  const WorldField world(settingsOf(kRooms, 1024), std::pmr::new_delete_resource());
  const Columns columns = sampled(world);
  const auto jobs = *makeThreadPool(1);
  const Result<Slice> slice = sampleSlice(world, columns, 0, {100, 100, 200, 100}, *jobs);
  REQUIRE_FALSE(slice);
  CHECK(slice.error().code == Code::invalid_argument);
  CHECK(readCutLine("-1,2.5:30,4")->x1 == 30);
  for (const char* text : {"", "1,2", "1,2:1,2", "1,2:3", "1,2:3,4x", "1,2,3:4,5,6", "1,2:nan,4", "1,2:9e9,1"})
    CHECK_FALSE(readCutLine(text));
}
