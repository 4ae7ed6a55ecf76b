// Tests that each function of the standard library is documented with an example, and that the examples derive.

#include <sstream>

#include "derive_fixture.h"
#include "grammar/std/std_library.h"

using namespace sgm;

namespace {

/// A declaration with the comment above it. A declaration without a comment is an internal helper.
struct Documented {
  std::string name;
  std::vector<std::string> comment;
};

std::string nameOf(const std::string& line) {
  for (const std::string_view word : {"let ", "field ", "rule ", "morphic "}) {
    if (line.rfind(word, 0) != 0) continue;
    const size_t begin = word.size();
    return line.substr(begin, line.find_first_of("( ", begin) - begin);
  }
  return {};
}

std::vector<Documented> documentedIn(std::string_view text) {
  std::vector<Documented> found;
  std::istringstream in{std::string(text)};
  std::vector<std::string> comment;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("// ", 0) == 0) {
      comment.push_back(line.substr(3));
      continue;
    }
    if (const std::string name = nameOf(line); !name.empty() && !comment.empty()) found.push_back({name, comment});
    comment.clear();
  }
  return found;
}

std::string programWith(std::string_view path, const std::string& example) {
  const size_t slash = path.find('/'), dot = path.find('.');
  const std::string module(path.substr(slash + 1, dot - slash - 1));
  const bool rules = example.rfind("rule ", 0) == 0, guarded = example.find(" when ") != std::string::npos;
  return "sgm 1; units m; import \"" + std::string(path) + "\" as " + module +
         ";\ndomain infinite;\nlayer all cell 1000m reach 900m { start A; }\n" +
         (rules ? example + (guarded ? "\nrule A else { }" : "")
                : "rule A { at(500m, 500m, 500m) { " + example + " } }");
}

}  // namespace

TEST_CASE("every function of the standard library has an example, which derives to something") {
  for (const StdFile& file : stdLibrary()) {
    const std::vector<Documented> all = documentedIn(file.text);
    CHECK(all.size() >= 2);
    for (const Documented& one : all) {
      CAPTURE(file.path, one.name);
      const std::string& last = one.comment.back();
      REQUIRE(last.rfind("Example: ", 0) == 0);
      CHECK(one.comment.size() >= 2);
      const std::string example = last.substr(9);
      const size_t use = example.find("." + one.name);
      REQUIRE(use != std::string::npos);
      const char after = example[std::min(use + 1 + one.name.size(), example.size() - 1)];
      CHECK((after == '(' || after == ';' || after == ' '));
      const auto program = compiled(programWith(file.path, example));
      size_t groups = 0;
      for (int x = 0; x < 8; ++x) {
        const GrammarChunk chunk = derived(*program, {x, 0, 0});
        groups += chunk.groups.size();
        for (const DeriveNote& note : chunk.notes) FAIL_CHECK(note.message);
      }
      CHECK(groups > 0);
    }
  }
}
