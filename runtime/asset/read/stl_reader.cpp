#include "asset/read/stl_reader.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "asset/read/mesh_notes.h"
#include "asset/read/text_reader.h"

namespace sgm::asset {

namespace {

constexpr size_t kCountAt = 80, kFacetsAt = 84, kFacetBytes = 50, kNormalBytes = 12;

uint32_t facetCount(std::span<const std::byte> bytes) {
  uint32_t count = 0;  // copied as it is: the file and all supported machines are little-endian
  std::memcpy(&count, bytes.data() + kCountAt, sizeof count);
  return count;
}

uint64_t sizeWith(uint64_t facets) { return kFacetsAt + kFacetBytes * facets; }

std::string_view textOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool isWord(std::string_view word, std::string_view lower) {
  if (word.size() != lower.size()) return false;
  for (size_t i = 0; i < word.size(); ++i)
    if (lowered(word[i]) != lower[i]) return false;
  return true;
}

void addFacet(TriangleMesh& mesh, const Point (&corners)[3]) {
  const uint32_t first = static_cast<uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), corners, corners + 3);
  mesh.triangles.push_back({first, first + 1, first + 2});
}

size_t maxFacets(const MeshLimits& limits) { return std::min(limits.triangles, limits.maxPoints() / 3); }

Result<TriangleMesh> readBinary(std::span<const std::byte> bytes, const MeshLimits& limits) {
  const size_t count = facetCount(bytes);
  if (count > maxFacets(limits)) return overLimit(maxFacets(limits), "triangles");
  TriangleMesh mesh;
  mesh.points.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const size_t at = sizeWith(i) + kNormalBytes;
    float v[9];
    std::memcpy(v, bytes.data() + at, sizeof v);
    Point corners[3];
    for (size_t k = 0; k < 3; ++k) {
      const Point& p = corners[k] = {double{v[3 * k]}, double{v[3 * k + 1]}, double{v[3 * k + 2]}};
      if (!limits.isPlace(p.x, p.y, p.z))
        return wrongAtByte("a triangle has a corner " + noPlaceWithin(limits), at + 12 * k);
    }
    addFacet(mesh, corners);
  }
  if (const size_t more = bytes.size() - sizeWith(count); more > 0)
    mesh.notes.push_back(counted(more, "byte after its last triangle is", "bytes after its last triangle are") +
                         " left out, at " + byteText(sizeWith(count)));
  return mesh;
}

class StlTextReader {
 public:
  StlTextReader(std::string_view text, const MeshLimits& limits) : text_(text), limits_(limits) {}

  Result<TriangleMesh> run() {
    for (std::string_view word = text_.wordOfAnyLine(); !word.empty(); word = text_.wordOfAnyLine()) {
      if (!isWord(word, "solid")) {
        // Text after the last solid, such as padding, is ignored. If it contains facets, the file is damaged.
        const size_t line = text_.line();
        const bool begun = !mesh_.triangles.empty();
        for (std::string_view more = word; begun && !isWord(more, "facet") && !isWord(more, "vertex");) {
          more = text_.wordOfAnyLine();
          if (!more.empty()) continue;
          mesh_.notes.push_back("text after its last `endsolid` is left out, at " + lineText(line));
          return std::move(mesh_);
        }
        return wrongAtLine(shown(word) + " stands where `solid` is expected", line);
      }
      text_.rest();  // skips the solid's name
      if (Result<void> read = solid(); !read) return read.error();
    }
    return std::move(mesh_);
  }

 private:
  Error failed(std::string_view due, std::string_view word) const {
    const std::string what = word.empty() ? "it ends" : shown(word) + " stands";
    return wrongAtLine(what + " where `" + std::string(due) + "` is expected", text_.line());
  }

  Result<void> solid() {
    for (;;) {
      const std::string_view word = text_.wordOfAnyLine();
      if (isWord(word, "endsolid")) break;
      if (!isWord(word, "facet")) return failed("facet", word);
      if (Result<void> read = facet(); !read) return read;
    }
    text_.rest();
    return {};
  }

  std::optional<Error> words(std::initializer_list<std::string_view> due) {
    for (const std::string_view one : due)
      if (const std::string_view word = text_.wordOfAnyLine(); !isWord(word, one)) return failed(one, word);
    return std::nullopt;
  }

  Result<void> facet() {
    if (mesh_.triangles.size() >= maxFacets(limits_)) return overLimit(maxFacets(limits_), "triangles");
    if (auto error = words({"normal"})) return *error;
    // Skip the normal without parsing it: degenerate triangles have normals such as "nan nan nan".
    for (int i = 0; i < 3; ++i) text_.wordOfAnyLine();
    if (auto error = words({"outer", "loop"})) return *error;
    Point corners[3];
    for (Point& p : corners) {
      if (auto error = words({"vertex"})) return *error;
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = text_.wordOfAnyLine();
        const std::optional<double> value = numberIn(word);
        if (!value)
          return wrongAtLine(word.empty() ? "it ends within a triangle" : shown(word) + " is not a number",
                             text_.line());
        p[axis] = *value;
      }
      if (!limits_.isPlace(p.x, p.y, p.z))
        return wrongAtLine("a triangle has a corner " + noPlaceWithin(limits_), text_.line());
    }
    if (auto error = words({"endloop", "endfacet"})) return *error;
    addFacet(mesh_, corners);
    return {};
  }

  TextReader text_;
  const MeshLimits& limits_;
  TriangleMesh mesh_;
};

/// True if the file contains all triangles that its header counts, and after them only as many bytes as some programs
/// append. If more bytes follow, the file probably has another format, in which the bytes at the place of the count
/// happen to be a small number.
bool hasLittleBehind(std::span<const std::byte> bytes) {
  constexpr uint64_t kMaxTrailer = 4096;
  if (bytes.size() < kFacetsAt || facetCount(bytes) == 0) return false;
  const uint64_t due = sizeWith(facetCount(bytes));
  return due < bytes.size() && bytes.size() - due <= kMaxTrailer + (due - kFacetsAt);
}

Result<TriangleMesh> readEither(std::span<const std::byte> bytes, const MeshLimits& limits) {
  if (isBinaryStl(bytes)) return readBinary(bytes, limits);
  if (isTextStl(bytes)) return StlTextReader(textOf(bytes), limits).run();
  if (hasLittleBehind(bytes)) return readBinary(bytes, limits);
  if (bytes.size() < kFacetsAt) return wrongAtByte("it is not an STL file: it ends within its header", bytes.size());
  return wrongAtByte("its header declares " + std::to_string(facetCount(bytes)) + " triangles, which take " +
                         std::to_string(sizeWith(facetCount(bytes))) + " bytes, and the file has " +
                         std::to_string(bytes.size()) + " bytes",
                     kCountAt);
}

}  // namespace

bool isTextStl(std::span<const std::byte> bytes) {
  // The header or count of binary STL always contains a zero byte; text never does.
  const std::string_view start = textOf(bytes.first(std::min<size_t>(bytes.size(), 512)));
  return isWord(TextReader(start).wordOfAnyLine(), "solid") && start.find('\0') == std::string_view::npos;
}

bool isBinaryStl(std::span<const std::byte> bytes) {
  return bytes.size() >= kFacetsAt && sizeWith(facetCount(bytes)) == bytes.size();
}

Result<TriangleMesh> readStl(std::span<const std::byte> bytes, const MeshLimits& limits) {
  Result<TriangleMesh> mesh = readEither(bytes, limits);
  if (!mesh) return mesh;
  if (mesh->triangles.empty()) return Error{Code::bad_input, "it has no triangles", 0, 0};
  mesh->materials.assign(mesh->triangles.size(), kNoMaterial);
  return mesh;
}

}  // namespace sgm::asset
