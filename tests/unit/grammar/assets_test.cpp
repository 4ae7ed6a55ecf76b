// Tests assets that a grammar imports, and the messages about invalid ones, word for word.

#include "bodies.h"
#include "catch.h"
#include "glb_bytes.h"
#include "messages.h"

using namespace sgm;
using namespace sgm::test;

namespace {

MapResolver withAssets() {
  MapResolver files;
  files.files["bay.glb"] = asset::glbOf(asset::archedBay(6));
  files.files["parts/house.glb"] = asset::glbOf(asset::gabledHouse());
  files.files["parts/yard.sgm"] = "sgm 1; import \"house.glb\" as house; rule Yard { fit house; }";
  asset::TriangleMesh open = asset::archedBay(6);
  open.triangles.pop_back();
  open.materials.pop_back();
  files.files["open.glb"] = asset::glbOf(open);
  files.files["fine.glb"] = asset::glbOf(asset::windowedWall(9, 7));
  files.files["text.glb"] = "sgm 1;";
  files.files["long.glb"] = std::string(2000, 'x');
  return files;
}

std::string said(const std::string& text) {
  MapResolver files = withAssets();
  return inWords(compileText(text, &files));
}

}  // namespace

TEST_CASE("an asset is imported as a file is, and read once", "[grammar][assets]") {
  MapResolver files = withAssets();
  const CompileResult result = compileText(
      "sgm 1; import \"bay.glb\" as bay; import \"parts/yard.sgm\" as yard; import \"parts/house.glb\" as house;\n"
      "start A; rule A { size(3m, 4m, 1m) fit bay stretch x 1m..2m repeat y 0m..1m; size(8m, 7m, 9m) { yard.Yard; fit "
      "house; } }",
      &files);
  INFO(renderDiagnostics(result));
  REQUIRE(result.program);
  CHECK(result.diagnostics.empty());
  REQUIRE(result.program->assets.size() == 2);
  CHECK(files.reads == 3);
  const Asset& house = result.program->assets[1];
  REQUIRE(house.materials.size() == 2);
  CHECK(result.program->materials[house.materials[1]] == "slate");
}

TEST_CASE("an asset's shape and materials are in the grammar's hash, and nothing else of it", "[grammar][assets]") {
  const auto hashWith = [](const asset::TriangleMesh& mesh) {
    MapResolver files;
    files.files["a.glb"] = asset::glbOf(mesh);
    const CompileResult result =
        compileText("sgm 1; import \"a.glb\" as a; start A; rule A { size(3m, 3m, 3m) fit a; }", &files);
    REQUIRE(result.program);
    return result.program->hash;
  };
  asset::TriangleMesh mesh = asset::gabledHouse();
  const uint64_t hash = hashWith(mesh);
  CHECK(hashWith(mesh) == hash);
  mesh.material_names.push_back("unused");
  CHECK(hashWith(mesh) == hash);
  mesh.material_names[1] = "tiles";
  CHECK(hashWith(mesh) != hash);
  mesh.material_names[1] = "slate";
  for (asset::Point& p : mesh.points) p.x *= 1.5;
  CHECK(hashWith(mesh) != hash);
}

TEST_CASE("what an asset's file has beside its triangles is a warning at the import", "[grammar][assets]") {
  MapResolver files = withAssets();
  std::string& bay = files.files["bay.glb"];
  bay += "behind";
  const std::string end = std::to_string(bay.size() - 6);
  // The contents of a file decide its format, here OBJ in a .glb file; a warning at the import reports that.
  files.files["cube.glb"] =
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\n"
      "f 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nl 1 2\n";
  const CompileResult result = compileText(
      "sgm 1; import \"bay.glb\" as bay;\nimport \"cube.glb\" as cube; start A; rule A { size(3m, 4m, 1m) { fit bay; "
      "fit cube; } }",
      &files);
  INFO(renderDiagnostics(result));
  REQUIRE(result.program);
  CHECK(inWords(result) ==
        "1:15 warning asset: `bay.glb`: 6 bytes after its end are left out, at byte " + end +
            "\n2:8 warning asset: `cube.glb`: by its bytes it is OBJ, not glTF as its name or type says, and "
            "is read as such\n2:8 warning asset: `cube.glb`: 1 element of lines or points is left out, at "
            "line 15");
  CHECK(result.program->assets[1].solid->volume() == Approx(8));
}

TEST_CASE("what is no asset is one error with what to do", "[grammar][assets]") {
  const auto importing = [](const std::string& file) {
    return said("sgm 1; import \"" + file + "\" as a; start A; rule A { fit a; }");
  };
  CHECK(importing("none.glb") ==
        "1:15 import-missing: cannot import `none.glb`: no such file | a path is relative to the folder of the file "
        "that imports it");
  CHECK(importing("text.glb") ==
        "1:15 asset: cannot import `text.glb`: it is a grammar (.sgm), not a mesh file | save it as binary glTF "
        "2.0 (.glb), all in one file, as triangles, uncompressed");
  CHECK_THAT(importing("open.glb"),
             Catch::Matchers::StartsWith("1:15 asset: cannot import `open.glb`: it is open at the edge from (") &&
                 Catch::Matchers::EndsWith(
                     ", which has no triangle on its other side | an asset must be closed: in the modelling tool fill "
                     "its holes, merge its points and make its faces point outwards"));
  CHECK(importing("fine.glb") ==
        "1:15 import-limit: cannot import `fine.glb`: it has 258 plane faces, and `fit` takes at most 256 | simplify "
        "it in "
        "the modelling tool, or fit it in several parts");
  MapResolver files = withAssets();
  CompileOptions options;
  options.resolver = &files;
  options.limits.asset_bytes = 1000;
  const std::string text =
      "sgm 1; import \"long.glb\" as a; import \"bay.glb\" as b; start A; rule A { fit a; fit b; }";
  CHECK(inWords(compileGrammar(text, "test.sgm", options)) ==
        "1:15 import-limit: `long.glb` is too long | a file has at most 1000 bytes, and all files together at most "
        "67108864\n1:39 import-limit: `bay.glb` is too long | a file has at most 1000 bytes, and all files together at "
        "most 67108864");
  options.limits.asset_bytes = 1 << 20;
  options.limits.files = 0;
  CHECK(inWords(compileGrammar("sgm 1; import \"bay.glb\" as b; start A; rule A { fit b; }", "test.sgm", options)) ==
        "1:15 import-limit: the program imports more than 0 assets | combine some of them");
}

TEST_CASE("what `fit` takes, and what takes no asset", "[grammar][assets]") {
  const auto inRule = [](const std::string& statement) {
    return said("sgm 1; import \"bay.glb\" as bay; start A; rule A { fit bay; " + statement +
                " } domain finite box(9m);");
  };
  CHECK(inRule("fit bya;") == "1:64 unknown-name: there is no asset `bya` | did you mean `bay`?");
  CHECK(inRule("fit tower;") ==
        "1:64 unknown-name: there is no asset `tower` | import it: `import \"tower.glb\" as tower;`");
  CHECK(inRule("fit A;") ==
        "1:64 wrong-use: `A` is not an asset | `fit` takes an asset that is imported from a .glb file, such as `import "
        "\"bay.glb\" as bay;`");
  CHECK(inRule("bay;") == "1:60 wrong-use: `bay` is an asset | put it into a scope: `fit bay;`");
  CHECK(inRule("bay.Door;") == "1:60 wrong-use: `bay` is an asset | put it into a scope: `fit bay;`");
  CHECK(inRule("sphere(bay.x);") == "1:67 wrong-use: `bay` is an asset | put it into a scope: `fit bay;`");
  CHECK(inRule("fit bay stretch x 1..2;") ==
        "1:78 unit-mismatch: the beginning of a zone is a length, and this is a ratio | write `1m`\n1:81 "
        "unit-mismatch: the end of a zone is a length, and this is a ratio | write `2m`");
  CHECK(inRule("fit;") == "1:63 syntax: expected the name of an imported asset, found `;`");
  CHECK(inRule("fit bay stretch w 1m..2m;") == "1:76 syntax: expected x, y or z to stretch along, found `w`");
  CHECK(inRule("fit bay repeat 1m..2m;") == "1:75 syntax: expected x, y or z to repeat along, found `1m`");
  CHECK(inRule("fit bay repeat x 1m;") ==
        "1:79 syntax: expected `..` and where the zone ends, such as `stretch x 1m..2m`, found `;`");
  CHECK(inRule("fit bay keep;") == "1:68 syntax: expected `stretch`, `repeat` or `;`, found `keep`");
  CHECK(
      inRule("sum { fit bay; }") ==
      "1:66 wrong-use: a sum has leaves only: spheres, blobs and other primitives | cut, displace or warp the sum as a "
      "whole");
  CHECK(said("sgm 1; import \"bay.glb\" as bay; start A; rule A { sphere(1m); }") ==
        "1:28 warning unused-value: nothing uses the import `bay` | use it, or remove it");
}

TEST_CASE("a `fit` is written in one way", "[grammar][assets]") {
  const FormatResult formatted = formatGrammar(
      "sgm 1; import \"bay.glb\" as bay; start A; rule A { fit   bay stretch x (1m)..2*3m  repeat  y 0m .. 1m; }",
      "t.sgm");
  REQUIRE(formatted.text);
  CHECK(formatted.text->find("fit bay stretch x (1m)..2*3m repeat y 0m..1m;") != std::string::npos);
  // A `fit` statement that is too long for one line gets a line for each zone, such as `stretch x 1m..2m`.
  const FormatResult lines = formatGrammar(
      "sgm 1; start A; rule A { size(8m, 9m, 4m) fit bay stretch x 1.25m..2.25m stretch x 3.75m..4.25m repeat y "
      "1.125m..2.125m stretch z 0.125m..0.375m; }",
      "t.sgm");
  REQUIRE(lines.text);
  CHECK(*lines.text ==
        "sgm 1;\nstart A;\nrule A {\n  size(8m, 9m, 4m) fit bay\n    stretch x 1.25m..2.25m\n    stretch x "
        "3.75m..4.25m\n    repeat y 1.125m..2.125m\n    stretch z 0.125m..0.375m;\n}\n");
  CHECK(formatGrammar(*lines.text, "t.sgm").text == lines.text);
  const FormatResult again = formatGrammar(*formatted.text, "t.sgm");
  CHECK(again.text == formatted.text);
}
