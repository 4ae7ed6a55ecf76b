#include "asset/obj_reader.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "asset/text_reader.h"

namespace sgm::asset {

namespace {

using Corners = std::array<uint32_t, 3>;

constexpr uint32_t kNoValue = 0xFFFFFFFFu;

/// The values of corners, or of points where all corners of each point have the same one; zero where there is none.
template <class Value>
void settleByPoint(CornerValues<Value>& of, const std::vector<Corners>& triangles, size_t points) {
  if (of.corners.empty()) {
    of.values.clear();
    return;
  }
  of.corners.resize(triangles.size(), {kNoValue, kNoValue, kNoValue});
  const uint32_t zero = static_cast<uint32_t>(of.values.size());
  of.values.push_back({});
  std::vector<uint32_t> of_point(points, kNoValue);
  bool same = true;
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      uint32_t& mine = of.corners[t][k];
      if (mine == kNoValue) mine = zero;
      uint32_t& known = of_point[triangles[t][k]];
      if (known == kNoValue) known = mine;
      same = same && (known == mine || of.values[known] == of.values[mine]);
    }
  }
  if (!same) return;
  std::vector<Value> by_point(points);
  for (size_t p = 0; p < points; ++p)
    if (of_point[p] != kNoValue) by_point[p] = of.values[of_point[p]];
  of.values = std::move(by_point);
  of.corners = {};
}

class ObjReader {
 public:
  ObjReader(std::string_view text, const MeshLimits& limits) : text_(text, true), limits_(limits) {}

  Result<TriangleMesh> run() {
    bool plain = false;
    do {
      const std::string_view keyword = text_.word();
      if (!line(keyword)) return *error_;
      plain = keyword.starts_with('#');
    } while (text_.nextLine(plain));
    if (!reaches(point_reach_, mesh_.points.size(), "point") ||
        !reaches(normal_reach_, mesh_.normals.values.size(), "normal") ||
        !reaches(coordinates_reach_, mesh_.coordinates.values.size(), "texture coordinates"))
      return *error_;
    if (mesh_.triangles.empty()) return Error{Code::bad_input, "it has no faces", 0, 0};
    settleByPoint(mesh_.normals, mesh_.triangles, mesh_.points.size());
    settleByPoint(mesh_.coordinates, mesh_.triangles, mesh_.points.size());
    return std::move(mesh_);
  }

 private:
  /// The highest number that faces have named so far, and where: what it names may come later.
  struct Reach {
    size_t number = 0, line = 0;
  };
  struct Corner {
    uint32_t point = kNoValue, coordinates = kNoValue, normal = kNoValue;
  };

  bool fail(std::string_view what) {
    error_ = wrongAtLine(what, text_.line());
    return false;
  }
  bool failLimit(size_t most, std::string_view of_what) {
    error_ = overLimit(most, of_what);
    return false;
  }

  bool line(std::string_view keyword) {
    if (keyword == "v") return point();
    if (keyword == "f") return face();
    if (keyword == "vn") return normal();
    if (keyword == "vt") return textureCoordinates();
    if (keyword == "usemtl") return material();
    return keyword.empty() || keyword[0] == '#' || isName(keyword) ||
           fail(shown(keyword) + " begins no line of an OBJ file");
  }

  static bool isName(std::string_view word) {
    return std::all_of(word.begin(), word.end(),
                       [](char c) {
                         return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
                       }) &&
           !(word[0] >= '0' && word[0] <= '9');
  }

  /// `least` numbers of the line at least, and at most `most`.
  bool numbers(double* out, size_t least, size_t most, std::string_view keyword) {
    for (size_t i = 0; i < most; ++i) {
      const std::string_view word = text_.word();
      if (word.empty() || word[0] == '#') {
        if (i >= least) return true;
        return fail("a `" + std::string(keyword) + "` has fewer than " + std::to_string(least) + " numbers");
      }
      const std::optional<double> value = numberIn(word);
      if (!value) return fail(shown(word) + " is no number");
      out[i] = *value;
    }
    return true;
  }

  bool point() {
    double v[3];
    if (!numbers(v, 3, 3, "v")) return false;
    if (!limits_.isPlace(v[0], v[1], v[2])) return fail("a point " + noPlaceWithin(limits_));
    if (mesh_.points.size() >= limits_.mostPoints()) return failLimit(limits_.mostPoints(), "points");
    mesh_.points.push_back({v[0], v[1], v[2]});
    return true;
  }

  bool normal() {
    double v[3];
    if (!numbers(v, 3, 3, "vn")) return false;
    if (!isFloat(v[0]) || !isFloat(v[1]) || !isFloat(v[2])) return fail("a normal that is not finite");
    if (mesh_.normals.values.size() >= kNoValue - 1) return failLimit(kNoValue - 1, "normals");
    mesh_.normals.values.push_back(unitNormal(v[0], v[1], v[2]));
    return true;
  }

  bool textureCoordinates() {
    double v[2] = {0, 0};
    if (!numbers(v, 1, 2, "vt")) return false;
    if (!isFloat(v[0]) || !isFloat(v[1])) return fail("texture coordinates that are not finite");
    if (mesh_.coordinates.values.size() >= kNoValue - 1) return failLimit(kNoValue - 1, "texture coordinates");
    mesh_.coordinates.values.push_back({static_cast<float>(v[0]), static_cast<float>(v[1])});
    return true;
  }

  bool material() {
    const std::string name = cleanName(text_.rest());
    const auto [at, fresh] = materials_.try_emplace(name, static_cast<uint32_t>(mesh_.material_names.size()));
    if (fresh && !name.empty()) mesh_.material_names.push_back(name);
    material_ = name.empty() ? kNoMaterial : at->second;
    return true;
  }

  bool face() {
    Corner first, last, next;
    size_t count = 0;
    for (;; ++count) {
      const std::string_view word = text_.word();
      if (word.empty() || word[0] == '#') break;
      if (!corner(word, next)) return false;
      if (count == 0) first = next;
      if (count >= 2 && !triangle(first, last, next)) return false;
      last = next;
    }
    return count >= 3 || fail("a face has fewer than three corners");
  }

  /// `point`, `point/coordinates`, `point//normal` or `point/coordinates/normal`.
  bool corner(std::string_view word, Corner& out) {
    out = {};
    const char *at = word.data(), *const end = at + word.size();
    bool good = number(at, end, mesh_.points.size(), point_reach_, out.point);
    if (good && at < end && *at == '/') {
      ++at;
      if (at < end && *at != '/')
        good = number(at, end, mesh_.coordinates.values.size(), coordinates_reach_, out.coordinates);
      if (good && at < end && *at == '/') {
        ++at;
        good = number(at, end, mesh_.normals.values.size(), normal_reach_, out.normal);
      }
    }
    if (good && at == end) return true;
    return fail(shown(word) + " is no corner of a face");
  }

  /// A number from 1, or from -1 backwards from what is `there` so far.
  bool number(const char*& at, const char* end, size_t there, Reach& reach, uint32_t& out) {
    // By hand: half of a file is such numbers. Longer ones than any that fits in 32 bits end as too large.
    const bool backwards = at < end && *at == '-';
    if (backwards) ++at;
    const char* const digits = at;
    int64_t given = 0;
    for (; at < end && *at >= '0' && *at <= '9'; ++at) given = std::min<int64_t>(10 * given + (*at - '0'), kNoValue);
    if (at == digits) return false;
    if (backwards) given = -given;
    if (given < 0) given += static_cast<int64_t>(there) + 1;
    if (given <= 0 || given >= int64_t{kNoValue}) return false;
    out = static_cast<uint32_t>(given - 1);
    if (static_cast<size_t>(given) > reach.number) reach = {static_cast<size_t>(given), text_.line()};
    return true;
  }

  bool triangle(const Corner& a, const Corner& b, const Corner& c) {
    if (mesh_.triangles.size() >= limits_.triangles) return failLimit(limits_.triangles, "triangles");
    addCorners(mesh_.normals.corners, {a.normal, b.normal, c.normal});
    addCorners(mesh_.coordinates.corners, {a.coordinates, b.coordinates, c.coordinates});
    mesh_.triangles.push_back({a.point, b.point, c.point});
    mesh_.materials.push_back(material_);
    return true;
  }

  /// Nothing is kept before the first face that has any.
  void addCorners(std::vector<Corners>& list, const Corners& corners) {
    constexpr Corners kNone{kNoValue, kNoValue, kNoValue};
    if (list.empty() && corners == kNone) return;
    list.resize(mesh_.triangles.size(), kNone);
    list.push_back(corners);
  }

  bool reaches(const Reach& reach, size_t there, std::string_view of_what) {
    if (reach.number <= there) return true;
    error_ = wrongAtLine("a face names " + std::string(of_what) + " " + std::to_string(reach.number) +
                             ", and the file has " + std::to_string(there),
                         reach.line);
    return false;
  }

  TextReader text_;
  const MeshLimits& limits_;
  TriangleMesh mesh_;
  std::map<std::string, uint32_t> materials_;
  uint32_t material_ = kNoMaterial;
  Reach point_reach_, normal_reach_, coordinates_reach_;
  std::optional<Error> error_;
};

}  // namespace

Result<TriangleMesh> readObj(std::span<const std::byte> bytes, const MeshLimits& limits) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF"; text.starts_with(kByteOrderMark))
    text.remove_prefix(kByteOrderMark.size());
  return ObjReader(text, limits).run();
}

}  // namespace sgm::asset
