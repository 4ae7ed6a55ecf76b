#include "asset/read/obj_reader.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "asset/read/mesh_notes.h"
#include "asset/read/polygon_cutter.h"
#include "asset/read/text_reader.h"
#include "asset/read/word_list.h"

namespace sgm::asset {

namespace {

using Corners = std::array<uint32_t, 3>;

constexpr uint32_t kNoValue = 0xFFFFFFFFu;

/// Keywords of lines that contain no triangles and are ignored without a note.
constexpr std::string_view kIdleWords[] = {
    "g",   "o",     "s",     "mg",         "mtllib",    "maplib", "usemap", "bevel", "c_interp", "d_interp", "lod",
    "vp",  "step",  "bmat",  "deg",        "cstype",    "parm",   "trim",   "hole",  "scrv",     "sp",       "end",
    "con", "ctech", "stech", "shadow_obj", "trace_obj", "bsp",    "bzp",    "cdc",   "cdp",      "res"};
constexpr std::string_view kCurveWords[] = {"curv", "curv2", "surf"};

/// If all corners of each point have the same value, replaces values per corner by one value per point. Corners and
/// points without a value get 0.
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
    if (point_reach_.number > mesh_.points.size())
      return wrongAtLine("a face names point " + std::to_string(point_reach_.number) + ", and the file has " +
                             std::to_string(mesh_.points.size()),
                         point_reach_.line);
    if (mesh_.triangles.empty()) return Error{Code::bad_input, "it has no faces", 0, 0};
    dropMissing(mesh_.normals, normal_reach_, "normals");
    dropMissing(mesh_.coordinates, coordinates_reach_, "texture coordinates");
    if (Result<void> done = cutter_.finish(); !done) return done.error();
    addNotes();
    settleByPoint(mesh_.normals, mesh_.triangles, mesh_.points.size());
    settleByPoint(mesh_.coordinates, mesh_.triangles, mesh_.points.size());
    return std::move(mesh_);
  }

 private:
  /// The highest index of points (or normals, or texture coordinates) that faces have used so far, and the line of this
  /// use. It cannot be checked at once, because the file may define the element later. Also counts invalid indices.
  struct Reach {
    size_t number = 0, line = 0;
    NotedPlaces never;
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
    if (keyword.empty() || keyword[0] == '#' || isIn(kIdleWords, keyword)) return true;
    if (keyword == "fo") return face();
    return otherLine(keyword);
  }

  [[gnu::noinline]] bool otherLine(std::string_view keyword) {
    const auto here = [&] { return lineText(text_.line()); };
    if (keyword == "l" || keyword == "p") {
      lines_.add(here);
    } else if (isIn(kCurveWords, keyword)) {
      curves_.add(here);
    } else if (keyword == "call" || keyword == "csh") {
      calls_.add(here);
    } else if (isName(keyword)) {
      unknown_.add([&] { return here() + ", " + shown(keyword); });
    } else {
      return fail(shown(keyword) + " is not a keyword of an OBJ file");
    }
    return true;
  }

  void addNotes() {
    addNote(mesh_.notes, lines_, "element of lines or points is left out", "elements of lines or points are left out");
    addNote(mesh_.notes, curves_, "curve or surface is left out", "curves and surfaces are left out",
            ": save it as polygons to have them");
    addNote(mesh_.notes, calls_, "call of another file or a command is left out",
            "calls of other files or commands are left out");
    addNote(mesh_.notes, unknown_, "line begins with a word that OBJ does not have and is left out",
            "lines begin with words that OBJ does not have and are left out");
  }

  static bool isName(std::string_view word) {
    return std::all_of(word.begin(), word.end(),
                       [](char c) {
                         return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
                       }) &&
           !(word[0] >= '0' && word[0] <= '9');
  }

  /// Reads at least `least` and at most `most` numbers from the line. Returns false after an error.
  bool numbers(double* out, size_t least, size_t most, std::string_view keyword) {
    for (size_t i = 0; i < most; ++i) {
      const std::string_view word = text_.word();
      if (word.empty() || word[0] == '#') {
        if (i >= least) return true;
        return fail("a `" + std::string(keyword) + "` has fewer than " + std::to_string(least) + " numbers");
      }
      const std::optional<double> value = numberIn(word);
      if (!value) return fail(shown(word) + " is not a number");
      out[i] = *value;
    }
    return true;
  }

  bool point() {
    double v[3];
    if (!numbers(v, 3, 3, "v")) return false;
    if (!limits_.isPlace(v[0], v[1], v[2])) return fail("a point " + noPlaceWithin(limits_));
    if (mesh_.points.size() >= limits_.maxPoints()) return failLimit(limits_.maxPoints(), "points");
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
    // Fast path: most faces are triangles, which need no list of corners.
    std::array<Corner, 3> first;
    std::string_view word;
    const auto more = [&] {
      word = text_.word();
      return !word.empty() && word[0] != '#';
    };
    for (Corner& one : first) {
      if (!more()) return fail("a face has fewer than three corners");
      if (!corner(word, one)) return false;
    }
    if (!more()) return triangle(first[0], first[1], first[2]);
    corners_.assign(first.begin(), first.end());
    for (Corner next; !word.empty() && word[0] != '#'; word = text_.word()) {
      if (!corner(word, next)) return false;
      corners_.push_back(next);
    }
    return polygon();
  }

  bool polygon() {
    dropRepeatedCorners(corners_, [](const Corner& a, const Corner& b) { return a.point == b.point; });
    for (size_t k = 2; k < corners_.size(); ++k)
      if (!triangle(corners_[0], corners_[k - 1], corners_[k])) return false;
    if (corners_.size() == 3) return true;
    Result<void> cut = cutter_.add(corners_.size(), text_.line());
    if (!cut) error_ = cut.error();
    return bool(cut);
  }

  /// Parses a corner of a face: `point`, `point/coordinates`, `point//normal` or `point/coordinates/normal`; the part
  /// after a slash may be empty.
  [[gnu::always_inline]] bool corner(std::string_view word, Corner& out) {
    out = {};
    const char *at = word.data(), *const end = at + word.size();
    bool good = number(at, end, mesh_.points.size(), point_reach_, out.point) && out.point != kNoValue;
    if (good && at < end && *at == '/') {
      ++at;
      if (at < end && *at != '/')
        good = number(at, end, mesh_.coordinates.values.size(), coordinates_reach_, out.coordinates);
      if (good && at < end && *at == '/') {
        ++at;
        if (at < end) good = number(at, end, mesh_.normals.values.size(), normal_reach_, out.normal);
      }
    }
    if (good && at == end) return true;
    return fail(shown(word) + " is not a corner of a face");
  }

  /// Parses an index, which counts from 1. A negative index counts backwards from the last element read so far; `there`
  /// is the number of these elements. Sets `out` to kNoValue if the index is invalid. Returns false if the text
  /// does not begin with digits.
  [[gnu::always_inline]] bool number(const char*& at, const char* end, size_t there, Reach& reach, uint32_t& out) {
    // Parse the digits here rather than by a library function, because half of a file consists of such numbers. A
    // number beyond 32 bits counts as an index that is too large.
    const bool backwards = at < end && *at == '-';
    if (backwards) ++at;
    const char* const digits = at;
    int64_t given = 0;
    for (; at < end && *at >= '0' && *at <= '9'; ++at) given = std::min<int64_t>(10 * given + (*at - '0'), kNoValue);
    if (at == digits) return false;
    if (backwards) given = -given;
    if (given < 0) given += static_cast<int64_t>(there) + 1;
    if (given <= 0 || given >= int64_t{kNoValue}) {
      neverThere(reach);
      return true;
    }
    out = static_cast<uint32_t>(given - 1);
    if (static_cast<size_t>(given) > reach.number) {
      reach.number = static_cast<size_t>(given);
      reach.line = text_.line();
    }
    return true;
  }

  [[gnu::noinline]] void neverThere(Reach& reach) {
    reach.never.add([&] { return "those at " + lineText(text_.line()); });
  }

  [[gnu::always_inline]] bool triangle(const Corner& a, const Corner& b, const Corner& c) {
    if (mesh_.triangles.size() >= limits_.triangles) return failLimit(limits_.triangles, "triangles");
    addCorners(mesh_.normals.corners, {a.normal, b.normal, c.normal});
    addCorners(mesh_.coordinates.corners, {a.coordinates, b.coordinates, c.coordinates});
    mesh_.triangles.push_back({a.point, b.point, c.point});
    mesh_.materials.push_back(material_);
    return true;
  }

  /// Appends the normals or texture coordinates of a triangle's corners. The list stays empty until a face first has
  /// such values.
  [[gnu::always_inline]] void addCorners(std::vector<Corners>& list, const Corners& corners) {
    constexpr Corners kNoCorners{kNoValue, kNoValue, kNoValue};
    if (list.empty() && corners == kNoCorners) return;
    list.resize(mesh_.triangles.size(), kNoCorners);
    list.push_back(corners);
  }

  /// Clears the value of corners that refer to normals or texture coordinates that the file does not contain.
  template <class Value>
  void dropMissing(CornerValues<Value>& of, const Reach& reach, std::string_view what) {
    const size_t there = of.values.size();
    NotedPlaces missing = reach.never;
    if (reach.number > there) {
      for (Corners& triangle : of.corners)
        for (uint32_t& corner : triangle)
          if (corner != kNoValue && corner >= there) {
            corner = kNoValue;
            ++missing.count;
          }
      if (there == 0) of.corners.clear();
      missing.first = "number " + std::to_string(reach.number) + " at " + lineText(reach.line);
    }
    if (missing.count == 0) return;
    mesh_.notes.push_back(counted(missing.count, "corner of a face names ", "corners of faces name ")
                              .append(what)
                              .append(" that the file does not have, such as ")
                              .append(missing.first)
                              .append(": read without them"));
  }

  TextReader text_;
  const MeshLimits& limits_;
  TriangleMesh mesh_;
  std::map<std::string, uint32_t> materials_;
  uint32_t material_ = kNoMaterial;
  Reach point_reach_, normal_reach_, coordinates_reach_;
  std::vector<Corner> corners_;
  PolygonCutter cutter_{mesh_, "line"};
  NotedPlaces lines_, curves_, calls_, unknown_;
  std::optional<Error> error_;
};

}  // namespace

Result<TriangleMesh> readObj(std::span<const std::byte> bytes, const MeshLimits& limits) {
  return ObjReader({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, limits).run();
}

}  // namespace sgm::asset
