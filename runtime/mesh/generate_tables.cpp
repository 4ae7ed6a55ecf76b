// Usage: generate_tables OUTPUT. Writes the case tables (tables.h) as one C++ source file. It is built for the host;
// CMake runs it at build time.

#include <cstdio>
#include <fstream>
#include <string>

#include "mesh/case_rule.h"

namespace {

using sgm::Cell;

void writeArray(std::ofstream& out, const std::string& declaration, const std::vector<size_t>& values) {
  out << declaration << " = {";
  for (size_t i = 0; i < values.size(); ++i) out << (i % 32 == 0 ? "\n  " : "") << values[i] << ',';
  out << "\n};\n";
}

/// Writes for each case the offset of its bytes, its bytes (length, edges, length, edges, ...), and its number of
/// triangles.
void writeCell(std::ofstream& out, const Cell& cell, const std::string& name, const std::string& start_type) {
  std::vector<size_t> starts{0}, bytes, triangles, faces, first;
  for (uint32_t solid = 0; solid < 1u << cell.corners; ++solid) {
    size_t count = 0;
    const size_t begin = bytes.size();
    for (const std::vector<int>& loop : sgm::loopsOfCase(cell, solid)) {
      bytes.push_back(loop.size());
      for (int e : loop) bytes.push_back(static_cast<size_t>(e));
      count += loop.size() - 2;
    }
    starts.push_back(bytes.size());
    const size_t length = begin == bytes.size() ? 0 : bytes[begin];
    const size_t more = begin + 1 + length < bytes.size() ? 1 : 0;
    first.push_back((begin + 1) | length << 16 | more << 24);
    triangles.push_back(count);
  }
  for (size_t e = 0; e < cell.edges.size(); ++e) faces.push_back(cell.facesOfEdge(static_cast<int>(e)));
  const std::string cases = std::to_string(1u << cell.corners);
  writeArray(out, "const " + start_type + " k" + name + "LoopStart[" + cases + " + 1]", starts);
  writeArray(out, "const uint8_t k" + name + "Loops[k" + name + "LoopBytes]", bytes);
  if (name == "Cube") writeArray(out, "const uint32_t kCubeFirstLoop[" + cases + "]", first);
  writeArray(out, "const uint8_t k" + name + "Triangles[" + cases + "]", triangles);
  writeArray(out, "const uint16_t k" + name + "EdgeFaces[" + std::to_string(cell.edges.size()) + "]", faces);
  out << "static_assert(" << bytes.size() << " == k" << name << "LoopBytes);\n\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: generate_tables OUTPUT\n");
    return 2;
  }
  std::ofstream out(argv[1], std::ios::binary);
  out << "// Made by runtime/mesh/generate_tables.cpp.\n#include \"mesh/tables.h\"\n\nnamespace sgm {\n\n";
  writeCell(out, sgm::cubeCell(), "Cube", "uint16_t");
  writeCell(out, sgm::seamCell(), "Seam", "uint32_t");
  out << "}  // namespace sgm\n";
  out.close();
  if (!out) {
    std::fprintf(stderr, "generate_tables: cannot write %s\n", argv[1]);
    return 4;
  }
  return 0;
}
