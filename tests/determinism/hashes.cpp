// Prints or checks hashes of fixed pieces of grammars, to compare builds and machines.
//
//   sgm_hashes GRAMMARS GOLDEN [--record | --threads N [--first]]
//
// Each line of GOLDEN is: grammar seed cell level x y z edge [sharp] hash. x y z is the cube's lowest corner; corner
// and edge are in chunks of that level, cell is in units. Every piece is meshed with 1, 2 and 8 threads, or with N
// only; with --first only the first piece of each grammar.
// --record writes the current hashes.

#include <sgm/sgm.h>

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

struct Piece {
  std::string grammar;
  uint64_t seed = 0;
  int32_t cell = 0, level = 0, corner[3] = {0, 0, 0}, edge = 0;
  bool sharp = false;
};

void check(sgm_result result, const sgm_error& error, const Piece& piece) {
  if (result == SGM_OK) return;
  throw std::runtime_error(piece.grammar + ":" + std::to_string(error.line) + ":" + std::to_string(error.column) +
                           ": " + sgm_result_name(result) + ": " + error.message);
}

// Returns the name of the instruction set that has meshed the pieces. Sets that this processor does not support are not
// tested.
std::string instructionSet() {
  sgm_error error = SGM_ERROR_INIT;
  sgm_runtime_desc with = SGM_RUNTIME_DESC_INIT;
  sgm_runtime* runtime = nullptr;
  check(sgm_runtime_create(&with, &runtime, &error), error, {});
  const std::unique_ptr<sgm_runtime, decltype(&sgm_runtime_destroy)> runtime_owner(runtime, sgm_runtime_destroy);
  sgm_backend_info info = SGM_BACKEND_INFO_INIT;
  check(sgm_backend_query(runtime, SGM_BACKEND_CPU, &info, &error), error, {});
  return info.device;
}

uint64_t hashOf(const Piece& piece, const std::string& folder, uint32_t threads) {
  sgm_error error = SGM_ERROR_INIT;
  sgm_runtime_desc with = SGM_RUNTIME_DESC_INIT;
  with.threads = threads;
  sgm_runtime* runtime = nullptr;
  check(sgm_runtime_create(&with, &runtime, &error), error, piece);
  const std::unique_ptr<sgm_runtime, decltype(&sgm_runtime_destroy)> runtime_owner(runtime, sgm_runtime_destroy);

  std::ifstream in(folder + "/" + piece.grammar, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + folder + "/" + piece.grammar);
  std::ostringstream text;
  text << in.rdbuf();
  const std::string source = text.str();
  sgm_grammar_desc desc = SGM_GRAMMAR_DESC_INIT;
  desc.text = source.data();
  desc.text_size = source.size();
  const std::string own_folder = std::filesystem::path(folder + "/" + piece.grammar).parent_path().string();
  desc.import_folder = own_folder.c_str();
  sgm_grammar* grammar = nullptr;
  check(sgm_grammar_compile(runtime, &desc, &grammar, nullptr, &error), error, piece);
  const std::unique_ptr<sgm_grammar, decltype(&sgm_grammar_destroy)> grammar_owner(grammar, sgm_grammar_destroy);

  sgm_field_desc field_desc = SGM_FIELD_DESC_INIT;
  field_desc.grammar = grammar;
  field_desc.seed = piece.seed;
  field_desc.cell_units = piece.cell;
  field_desc.backend = SGM_BACKEND_CPU;
  sgm_field* field = nullptr;
  check(sgm_field_create(runtime, &field_desc, &field, &error), error, piece);
  const std::unique_ptr<sgm_field, decltype(&sgm_field_destroy)> field_owner(field, sgm_field_destroy);

  sgm_region_desc region = SGM_REGION_DESC_INIT;
  region.level = piece.level;
  region.flags = piece.sharp ? SGM_MESHING_SHARP : 0;
  const int32_t chunk = (piece.cell << piece.level) * SGM_CHUNK_CELLS;
  for (int axis = 0; axis < 3; ++axis) {
    region.minimum[axis] = piece.corner[axis] * chunk;
    region.maximum[axis] = (piece.corner[axis] + piece.edge) * chunk;
  }
  sgm_surface* surface = nullptr;
  check(sgm_surface_from_region(field, &region, &surface, &error), error, piece);
  const std::unique_ptr<sgm_surface, decltype(&sgm_surface_destroy)> surface_owner(surface, sgm_surface_destroy);
  sgm_surface_view view = SGM_SURFACE_VIEW_INIT;
  check(sgm_surface_get_view(surface, &view, &error), error, piece);
  if (view.index_count == 0)
    throw std::runtime_error(piece.grammar + " at " + std::to_string(piece.corner[0]) +
                             ": a piece without a surface proves nothing");
  return sgm_surface_hash(surface);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::fprintf(stderr, "usage: sgm_hashes GRAMMARS GOLDEN [--record | --threads N [--first]]\n");
    return 2;
  }
  const bool record = argc > 3 && std::strcmp(argv[3], "--record") == 0;
  std::vector<uint32_t> thread_counts{1, 2, 8};
  if (argc > 4 && std::strcmp(argv[3], "--threads") == 0) thread_counts = {static_cast<uint32_t>(std::stoul(argv[4]))};
  const bool first_alone = argc > 5 && std::strcmp(argv[5], "--first") == 0;
  std::ifstream golden(argv[2]);
  if (!golden) throw std::runtime_error(std::string("cannot read ") + argv[2]);
  std::ostringstream out;
  int wrong = 0, pieces = 0;
  std::string last;
  for (std::string line; std::getline(golden, line);) {
    if (line.empty() || line[0] == '#') {
      out << line << '\n';
      continue;
    }
    Piece p;
    std::string expected;
    std::istringstream words(line);
    words >> p.grammar >> p.seed >> p.cell >> p.level >> p.corner[0] >> p.corner[1] >> p.corner[2] >> p.edge;
    if (!words) throw std::runtime_error("not understood: " + line);
    words >> expected;
    p.sharp = expected == "sharp";
    if (p.sharp) words >> expected;
    if (std::exchange(last, p.grammar) == p.grammar && first_alone) continue;
    ++pieces;
    char first[17] = "";
    for (const uint32_t threads : thread_counts) {
      char hash[17];
      std::snprintf(hash, sizeof hash, "%016" PRIx64, hashOf(p, argv[1], threads));
      if (threads == thread_counts.front()) std::memcpy(first, hash, sizeof hash);
      const bool same = std::strcmp(hash, first) == 0 && (record || hash == expected);
      if (!same) {
        std::printf("DIFFERENT with %u threads: %s: %s\n", threads, line.c_str(), hash);
        ++wrong;
      }
    }
    out << p.grammar << ' ' << p.seed << ' ' << p.cell << ' ' << p.level << ' ' << p.corner[0] << ' ' << p.corner[1]
        << ' ' << p.corner[2] << ' ' << p.edge << (p.sharp ? " sharp " : " ") << first << '\n';
  }
  golden.close();
  if (record && !wrong) std::ofstream(argv[2]) << out.str();
  std::printf("%s\n%d pieces by %s, %d differences\n", sgm_build_info(), pieces, instructionSet().c_str(), wrong);
  return wrong == 0 && pieces > 0 ? 0 : 1;
} catch (const std::exception& e) {
  std::fprintf(stderr, "sgm_hashes: error: %s\n", e.what());
  return 1;
}
