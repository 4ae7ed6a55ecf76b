#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "fixture.h"
#include "temporary_folder.h"

namespace {

struct Compiled {
  sgm_result result;
  GrammarOwner grammar;
  DiagnosticsOwner diagnostics;
  sgm_error error = SGM_ERROR_INIT;
};

Compiled tryCompile(sgm_runtime* runtime, const sgm_grammar_desc& desc) {
  Compiled compiled;
  sgm_grammar* grammar = nullptr;
  sgm_diagnostics* diagnostics = nullptr;
  compiled.result = sgm_grammar_compile(runtime, &desc, &grammar, &diagnostics, &compiled.error);
  compiled.grammar.reset(grammar);
  compiled.diagnostics.reset(diagnostics);
  return compiled;
}

sgm_grammar_desc describe(const char* text) {
  sgm_grammar_desc desc = SGM_GRAMMAR_DESC_INIT;
  desc.text = text;
  return desc;
}

}  // namespace

TEST_CASE("a wrong grammar gives its diagnostics, with places and the line") {
  RuntimeOwner runtime = makeRuntime();
  sgm_grammar_desc desc = describe("sgm 1;\nunits m;\nstart Ball;\nrule Ball { sphere(3deg); }\n");
  desc.name = "toy.sgm";
  const Compiled compiled = tryCompile(runtime.get(), desc);
  CHECK(compiled.result == SGM_ERR_GRAMMAR);
  CHECK(compiled.grammar == nullptr);
  CHECK(compiled.error.code == SGM_ERR_GRAMMAR);
  CHECK(compiled.error.line == 4);
  CHECK(compiled.error.column == 20);
  REQUIRE(sgm_diagnostics_count(compiled.diagnostics.get()) >= 1);
  sgm_diagnostic d = SGM_DIAGNOSTIC_INIT;
  REQUIRE(sgm_diagnostics_get(compiled.diagnostics.get(), 0, &d) == SGM_OK);
  CHECK(d.severity == SGM_LOG_ERROR);
  CHECK(d.line == 4);
  CHECK(d.column == 20);
  CHECK(d.length == 4);
  CHECK(std::string(d.file) == "toy.sgm");
  CHECK(std::string(d.source_line) == "rule Ball { sphere(3deg); }");
  CHECK(std::string(d.message) + " (" + d.hint + ")" == compiled.error.message);
  CHECK(sgm_diagnostics_get(compiled.diagnostics.get(), sgm_diagnostics_count(compiled.diagnostics.get()), &d) ==
        SGM_ERR_NOT_FOUND);
}

TEST_CASE("text need not end in 0") {
  RuntimeOwner runtime = makeRuntime();
  const std::string text = std::string(kBall) + "this is not read";
  sgm_grammar_desc desc = describe(text.c_str());
  desc.text_size = std::strlen(kBall);
  const Compiled view = tryCompile(runtime.get(), desc);
  CHECK(view.result == SGM_OK);
  const Compiled whole = tryCompile(runtime.get(), describe(kBall));
  CHECK(sgm_grammar_hash(view.grammar.get()) == sgm_grammar_hash(whole.grammar.get()));
  CHECK(sgm_grammar_hash(whole.grammar.get()) != 0);
}

TEST_CASE("the hash is blind to layout and sees meaning") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner a = compile(runtime.get(), "sgm 1; units m; start R; rule R { sphere(3m); }");
  const GrammarOwner b = compile(runtime.get(), "sgm 1;\n\nunits m;\nstart R; // here\nrule R {\n  sphere(3m); }");
  const GrammarOwner c = compile(runtime.get(), "sgm 1; units m; start R; rule R { sphere(4m); }");
  CHECK(sgm_grammar_hash(a.get()) == sgm_grammar_hash(b.get()));
  CHECK(sgm_grammar_hash(a.get()) != sgm_grammar_hash(c.get()));
}

TEST_CASE("names by index") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  REQUIRE(sgm_grammar_material_count(grammar.get()) == 2);
  CHECK(std::string(sgm_grammar_material(grammar.get(), 0)).empty());
  CHECK(std::string(sgm_grammar_material(grammar.get(), 1)) == "marble");
  CHECK(sgm_grammar_material(grammar.get(), 2) == nullptr);
  REQUIRE(sgm_grammar_tag_count(grammar.get()) == 2);
  CHECK(std::string(sgm_grammar_tag(grammar.get(), 1)) == "toy.ball");
  CHECK(sgm_grammar_tag(grammar.get(), 99) == nullptr);
  CHECK(sgm_grammar_name_count(grammar.get()) >= 2);
  CHECK(sgm_grammar_name(grammar.get(), 0xFFFFFFFFu) == nullptr);
  REQUIRE(sgm_grammar_layer_count(grammar.get()) == 1);
  sgm_layer_info layer = SGM_LAYER_INFO_INIT;
  REQUIRE(sgm_grammar_layer(grammar.get(), 0, &layer) == SGM_OK);
  CHECK(std::string(layer.name) == "main");
  CHECK(layer.reach_units >= 0);
  CHECK(sgm_grammar_layer(grammar.get(), 1, &layer) == SGM_ERR_NOT_FOUND);
}

TEST_CASE("lengths without a unit are in the grammar's units") {
  RuntimeOwner runtime = makeRuntime();
  for (const auto& [units, radius] :
       {std::pair{"units cm; ", 0.3}, {"units mm; ", 0.03}, {"units m; ", 30.0}, {"", -1.0}}) {
    CAPTURE(units);
    const GrammarOwner grammar =
        compile(runtime.get(), (std::string("sgm 1; ") + units +
                                "param r = 2m in 1mm..5km; domain finite box(9km); start A; rule A { sphere(r); }")
                                   .c_str());
    sgm_parameters* made = nullptr;
    sgm_error error = SGM_ERROR_INIT;
    REQUIRE(sgm_parameters_create(grammar.get(), &made, &error) == SGM_OK);
    const ParametersOwner parameters(made);
    CHECK(sgm_parameters_set_text(made, "r", "30", &error) == (radius > 0 ? SGM_OK : SGM_ERR_GRAMMAR));
    double value = -1;
    CHECK(sgm_parameters_get(made, "r", &value, nullptr) == SGM_OK);
    CHECK(value == (radius > 0 ? radius : 2.0));
    CHECK(sgm_parameters_set_text(made, "r", "50%", &error) == SGM_ERR_GRAMMAR);
    CHECK(sgm_parameters_set_text(made, "r", "4km", &error) == SGM_OK);
  }
}

TEST_CASE("parameters are listed, set within their range, and read back") {
  RuntimeOwner runtime = makeRuntime();
  const GrammarOwner grammar = compile(runtime.get(), kBall);
  REQUIRE(sgm_grammar_parameter_count(grammar.get()) == 3);
  sgm_parameter_info info = SGM_PARAMETER_INFO_INIT;
  REQUIRE(sgm_grammar_parameter(grammar.get(), 0, &info) == SGM_OK);
  CHECK(std::string(info.name) == "radius");
  CHECK(std::string(info.doc) == "radius");
  CHECK(info.quantity == SGM_QUANTITY_LENGTH);
  CHECK(info.default_value == 3.0);
  CHECK(info.minimum == 1.0);
  CHECK(info.maximum == 3.5);
  CHECK(info.whole == 0);
  CHECK(info.animated == 1);
  REQUIRE(sgm_grammar_parameter(grammar.get(), 1, &info) == SGM_OK);
  CHECK(info.quantity == SGM_QUANTITY_NUMBER);
  CHECK(info.whole == 1);
  CHECK(info.animated == 0);
  REQUIRE(sgm_grammar_parameter(grammar.get(), 2, &info) == SGM_OK);
  CHECK(info.quantity == SGM_QUANTITY_ANGLE);
  CHECK(std::isinf(info.maximum));
  CHECK(sgm_grammar_parameter(grammar.get(), 3, &info) == SGM_ERR_NOT_FOUND);

  sgm_parameters* made = nullptr;
  sgm_error error = SGM_ERROR_INIT;
  REQUIRE(sgm_parameters_create(grammar.get(), &made, &error) == SGM_OK);
  const ParametersOwner parameters(made);
  const auto get = [&](const char* name) {
    double value = -1;
    CHECK(sgm_parameters_get(made, name, &value, nullptr) == SGM_OK);
    return value;
  };
  CHECK(get("radius") == 3.0);
  CHECK(sgm_parameters_set(made, "radius", 2.5, &error) == SGM_OK);
  CHECK(get("radius") == 2.5);
  CHECK(sgm_parameters_set_text(made, "radius", "250cm", &error) == SGM_OK);
  CHECK(get("radius") == 2.5);
  CHECK(sgm_parameters_set_text(made, "turn", "-90deg", &error) == SGM_OK);
  CHECK(get("turn") == Approx(-1.5707963267948966).epsilon(1e-15));

  struct Wrong {
    const char* name;
    const char* text;
    sgm_result result;
  };
  for (const Wrong& wrong :
       {Wrong{"turn", "2", SGM_ERR_GRAMMAR}, Wrong{"radius", "2deg", SGM_ERR_GRAMMAR},
        Wrong{"radius", "", SGM_ERR_GRAMMAR}, Wrong{"radius", "2m 3m", SGM_ERR_GRAMMAR},
        Wrong{"radius", "wide", SGM_ERR_GRAMMAR}, Wrong{"radius", "9m", SGM_ERR_INVALID_ARGUMENT},
        Wrong{"count", "2.5", SGM_ERR_INVALID_ARGUMENT}, Wrong{"raduis", "2m", SGM_ERR_NOT_FOUND}}) {
    INFO(wrong.name << " = " << wrong.text);
    CHECK(sgm_parameters_set_text(made, wrong.name, wrong.text, &error) == wrong.result);
    CHECK(std::strlen(error.message) > 0);
  }
  for (const double value : {std::nan(""), HUGE_VAL, 0.0, 1e9})
    CHECK(sgm_parameters_set(made, "radius", value, &error) == SGM_ERR_INVALID_ARGUMENT);
  CHECK(sgm_parameters_set(made, "raduis", 2, &error) == SGM_ERR_NOT_FOUND);
  CHECK(std::string(error.message).find("radius") != std::string::npos);
  CHECK(get("radius") == 2.5);
}

TEST_CASE("imports come from the callback, from the folder, and from nowhere else") {
  RuntimeOwner runtime = makeRuntime();
  namespace fs = std::filesystem;
  const sgm::TemporaryFolder temporary;
  const fs::path& folder = temporary.path;
  fs::create_directories(folder / "inner");
  std::ofstream(folder / "inner" / "part.sgm") << "sgm 1; let width() = 2m;";
  std::ofstream(folder / "secret.sgm") << "sgm 1; let width() = 2m;";
  fs::create_symlink("../secret.sgm", folder / "inner" / "link.sgm");
  const auto text = [](const std::string& path) {
    return "sgm 1; import \"" + path + "\" as part; units m; start R; rule R { sphere(part.width()); }";
  };

  const std::string own = text("part.sgm");
  sgm_grammar_desc desc = describe(own.c_str());
  CHECK(tryCompile(runtime.get(), desc).result == SGM_ERR_GRAMMAR);
  const std::string inner = (folder / "inner").string();
  desc.import_folder = inner.c_str();
  CHECK(tryCompile(runtime.get(), desc).result == SGM_OK);

  for (const char* path : {"../secret.sgm", "/etc/passwd", "link.sgm", "none.sgm", "../inner/part.sgm"}) {
    const std::string other = text(path);
    desc.text = other.c_str();
    const Compiled compiled = tryCompile(runtime.get(), desc);
    INFO(path << ": " << compiled.error.message);
    CHECK(compiled.result == SGM_ERR_GRAMMAR);
    CHECK(compiled.error.line == 1);
  }

  desc = describe(own.c_str());
  std::string asked;
  desc.import_user = &asked;
  desc.import_text = [](void* user, const char* path, const char** found, size_t* size) -> int32_t {
    *static_cast<std::string*>(user) = path;
    *found = "sgm 1; let width() = 1m;";
    *size = std::strlen(*found);
    return 1;
  };
  CHECK(tryCompile(runtime.get(), desc).result == SGM_OK);
  CHECK(asked == "part.sgm");
  desc.import_text = [](void*, const char*, const char**, size_t*) -> int32_t { return 0; };
  CHECK(tryCompile(runtime.get(), desc).result == SGM_ERR_GRAMMAR);
}

TEST_CASE("a grammar says where its world lies") {
  RuntimeOwner runtime = makeRuntime();
  sgm_domain_info info = SGM_DOMAIN_INFO_INIT;
  const GrammarOwner ball = compile(runtime.get(), kBall);
  REQUIRE(sgm_grammar_domain(ball.get(), &info) == SGM_OK);
  CHECK(info.infinite == 0);
  CHECK(info.solid == 0);
  CHECK(info.density == 0);
  CHECK(info.density_edge == 0);
  for (size_t axis = 0; axis < 3; ++axis) {
    CHECK(info.cut[axis] == 0);
    // The bounds must contain the ball even with its largest radius.
    CHECK(info.minimum[axis] <= 4 * 1024 - 3584);
    CHECK(info.maximum[axis] >= 4 * 1024 + 3584);
  }
  const GrammarOwner box = compile(runtime.get(),
                                   "sgm 1; units m; domain finite solid chalk box(8m, 6m, 4m);\n"
                                   "start Hole; rule Hole { cut { sphere(1m); } }");
  REQUIRE(sgm_grammar_domain(box.get(), &info) == SGM_OK);
  CHECK(info.infinite == 0);
  CHECK(info.solid == 1);
  CHECK(std::string(sgm_grammar_material(box.get(), info.material)) == "chalk");
  CHECK(info.minimum[0] == -4096);
  CHECK(info.maximum[1] == 3072);
  const GrammarOwner fog = compile(runtime.get(),
                                   "sgm 1; units m; domain infinite axes xz output density;\n"
                                   "layer main cell 16m reach 4m { start Puff; } rule Puff { sphere(2m); }");
  REQUIRE(sgm_grammar_domain(fog.get(), &info) == SGM_OK);
  CHECK(info.infinite == 1);
  CHECK(info.density == 1);
  CHECK(info.density_edge == 10.0f);
  CHECK(info.cut[0] == 1);
  CHECK(info.cut[1] == 0);
  CHECK(info.cut[2] == 1);
  CHECK(info.maximum[0] == 0);
}
