// Tests the report of `sgm fly --measure`.

#include "tools/flight/fly_measures.h"
#include "catch.h"

using namespace sgm::cli;

TEST_CASE("a defect of any kind among the chunks that were made is told, and none where there is none") {
  CHECK_FALSE(defectOf(sgm_world_measures SGM_WORLD_MEASURES_INIT));
  for (size_t kind = 0; kind <= SGM_DEFECT_PINCHED_VERTEX; ++kind) {
    sgm_world_measures measures = SGM_WORLD_MEASURES_INIT;
    measures.made.defects[kind] = 17;
    REQUIRE(defectOf(measures));
    CHECK(defectOf(measures)->starts_with("chunks with 17 "));
    CHECK(toJson(measures).text().find("\": 17") != std::string::npos);
  }
  sgm_world_measures measures = SGM_WORLD_MEASURES_INIT;
  measures.made.defects[SGM_DEFECT_OPEN_EDGE] = 3;
  measures.made.defects[SGM_DEFECT_PINCHED_VERTEX] = 1;
  CHECK(*defectOf(measures) == "chunks with 3 open edges, 1 non-manifold vertices");
  measures.measuring_seconds = 1;
  measures.meshing_seconds = 8;
  CHECK(toJson(measures).text().find("\"share_of_meshing\": 0.125") != std::string::npos);
}
