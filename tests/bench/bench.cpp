// The benchmark: each fixed scene meshed by us, straight from the field and from a grid of samples, beside VTK's Flying
// Edges on that same grid; what the meshes have in common is checked before a time is believed. See README.md.
//
//   sgm_bench [--cells N] [--runs N] [--threads N] [--scene NAME] [--csv FILE] [--vtk PROGRAM]

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "ours.h"

namespace {

using namespace bench;

struct Options {
  int cells = 256, runs = 7, threads = 1;
  std::string scene, csv, vtk = SGM_BENCH_VTK, cave = SGM_BENCH_CAVE, grid = "sgm_bench_grid.bin";
};

struct Row {
  std::string scene, stage;
  Times times;
  Shape shape;
};

double megatriangles(const Row& row) { return static_cast<double>(row.shape.triangles) / row.times.median / 1e3; }

// A pass that reads every sample's sign once, as fast as the memory gives them: no extraction can be faster than this.
Times signPass(const Grid& grid, int runs) {
  volatile uint32_t solid = 0;
  return timed(2, runs, [&] {
    uint32_t count = 0;
    for (const float value : grid.values) count += std::bit_cast<uint32_t>(value) >> 31;
    solid = count;
  });
}

// The peer's line of key=value; empty where it is not built.
std::map<std::string, std::string> flyingEdges(const Options& options) {
  std::map<std::string, std::string> values;
  if (options.vtk.empty()) return values;
  const std::string command = "'" + options.vtk + "' '" + options.grid + "' " + std::to_string(options.threads) + " " +
                              std::to_string(options.runs);
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot run " + command);
  char line[512] = "";
  const bool answered = std::fgets(line, sizeof line, pipe) != nullptr;
  if (pclose(pipe) != 0 || !answered) throw std::runtime_error("failed: " + command);
  std::istringstream words(line);
  for (std::string word; words >> word;) values[word.substr(0, word.find('='))] = word.substr(word.find('=') + 1);
  return values;
}

bool near(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance * std::abs(b); }

// What must be true of a row before its time means anything.
bool agrees(const Row& row, const Shape& peer) {
  bool good = true;
  if (row.shape.open_edges) {
    std::printf("  WRONG: %s has %zu open edges\n", row.stage.c_str(), row.shape.open_edges);
    good = false;
  }
  if (!near(row.shape.area, peer.area, 0.01)) {
    std::printf("  WRONG: area %.1f of %s is not within 1%% of %.1f\n", row.shape.area, row.stage.c_str(), peer.area);
    good = false;
  }
  if (!near(static_cast<double>(row.shape.triangles), static_cast<double>(peer.triangles), 0.02)) {
    std::printf("  WRONG: %zu triangles of %s are not within 2%% of %zu\n", row.shape.triangles, row.stage.c_str(),
                peer.triangles);
    good = false;
  }
  return good;
}

void print(const Row& row, double peer) {
  std::printf("%-8s %-34s %9.2f %9.2f %9.2f %10zu %9.2f", row.scene.c_str(), row.stage.c_str(), row.times.median,
              row.times.least, row.times.most, row.shape.triangles, megatriangles(row));
  if (peer > 0) std::printf(" %7.2fx", peer / row.times.median);
  std::printf("\n");
}

bool runScene(const Scene& scene, const Options& options, std::vector<Row>& rows) {
  Ours ours(scene, options.cells, options.threads);
  std::vector<Row> mine;
  const double start = now();
  ours.meshChunks();
  const double first = now() - start;
  mine.push_back({scene.name, "sgm: derive + evaluate + mesh", statistics({first}), {}});
  mine.push_back({scene.name, "sgm: evaluate + mesh", timed(1, options.runs, [&] { ours.meshChunks(); }), {}});
  mine[0].shape = mine[1].shape = measure(ours.welded(), options.cells);

  const Grid grid = ours.sample();
  mine.push_back(
      {scene.name, "sgm: mesh a grid, with normals", timed(2, options.runs, [&] { ours.meshGrid(grid); }), {}});
  mine[2].shape = measure(ours.gridMesh(grid), options.cells);
  mine.push_back({scene.name, "floor: read the grid's signs", signPass(grid, options.runs), {}});

  writeGrid(options.grid, grid);
  auto fe = flyingEdges(options);
  std::remove(options.grid.c_str());
  Shape peer = mine[2].shape;
  double peer_time = 0;
  if (!fe.empty()) {
    peer = {std::stoul(fe["vertices"]), std::stoul(fe["triangles"]), std::stod(fe["area"]), std::stoul(fe["open"])};
    peer_time = std::stod(fe["median"]);
    mine.push_back({scene.name,
                    "VTK " + fe["version"] + " Flying Edges, normals",
                    {peer_time, std::stod(fe["least"]), std::stod(fe["most"]), options.runs},
                    peer});
  }
  for (const Row& row : mine) print(row, row.shape.triangles && row.stage[0] == 's' ? peer_time : 0);
  bool good = true;
  for (size_t i = 1; i < 3; ++i) good = agrees(mine[i], peer) && good;
  rows.insert(rows.end(), mine.begin(), mine.end());
  return good;
}

void writeCsv(const Options& options, const std::string& device, const std::vector<Row>& rows) {
  std::ofstream out(options.csv);
  out << "scene,cells,threads,device,stage,runs,median_ms,least_ms,most_ms,vertices,triangles,area_cells,open_edges\n";
  out.precision(9);
  for (const Row& row : rows)
    out << row.scene << ',' << options.cells << ',' << options.threads << ',' << device << ",\"" << row.stage << "\","
        << row.times.runs << ',' << row.times.median << ',' << row.times.least << ',' << row.times.most << ','
        << row.shape.vertices << ',' << row.shape.triangles << ',' << row.shape.area << ',' << row.shape.open_edges
        << '\n';
  out.flush();
  if (!out) throw std::runtime_error("cannot write " + options.csv);
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (i + 1 == argc) throw std::runtime_error(name + " needs a value");
    const char* value = argv[i + 1];
    if (name == "--cells")
      options.cells = std::atoi(value);
    else if (name == "--runs")
      options.runs = std::atoi(value);
    else if (name == "--threads")
      options.threads = std::atoi(value);
    else if (name == "--scene")
      options.scene = value;
    else if (name == "--csv")
      options.csv = value;
    else if (name == "--vtk")
      options.vtk = value;
    else
      throw std::runtime_error("unknown option " + name);
  }
  if (options.cells < 64 || (options.cells & (options.cells - 1)) != 0 || options.cells > 1024)
    throw std::runtime_error("--cells is 64, 128, 256, 512 or 1024: the cave's cells are whole units for no other");
  if (options.runs < 1 || options.threads < 1) throw std::runtime_error("--runs and --threads are at least 1");
  return options;
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options = parse(argc, argv);
  pin(options.threads);
  std::vector<Row> rows;
  std::string device;
  bool good = true, found = false;
  for (const Scene& scene : makeScenes(options.cells, options.cave)) {
    if (!options.scene.empty() && scene.name != options.scene) continue;
    if (!found) {
      device = Ours(scene, options.cells, options.threads).device();
      std::printf("%d^3 cells, %d thread(s), %s, %d runs after a warm-up; milliseconds\n", options.cells,
                  options.threads, device.c_str(), options.runs);
      if (options.vtk.empty())
        std::printf("Without the peer: install libvtk9-dev and configure again to compare with VTK's Flying Edges.\n");
      std::printf("%-8s %-34s %9s %9s %9s %10s %9s %8s\n", "scene", "stage", "median", "least", "most", "triangles",
                  "Mtri/s", "peer/us");
      found = true;
    }
    good = runScene(scene, options, rows) && good;
  }
  if (!found) throw std::runtime_error("no scene is called " + options.scene);
  if (!options.csv.empty()) writeCsv(options, device, rows);
  return good ? 0 : 1;
} catch (const std::exception& e) {
  std::fprintf(stderr, "sgm_bench: error: %s\n", e.what());
  return 1;
}
