#pragma once
// The subcommands of `sgm`, one source each: what they are asked, and what runs. How the command line asks is in
// arguments/ alone.

#include <optional>
#include <string>
#include <vector>

#include "base/file_writer.h"
#include "cli/console.h"
#include "cli/ending_signals.h"
#include "cli/options.h"
#include "cli/serving.h"

namespace sgm::cli {

/// Of this process: a signal handler has nothing else to hold on to. In main.cpp.
extern UnfinishedFiles unfinished_files;
extern EndingSignals ending_signals;

struct CheckOptions : WorldOptions {
  std::vector<std::string> files;
  bool expect = false;
  uint64_t seeds = 1;
};
Exit check(const CheckOptions& options);

struct FmtOptions {
  std::vector<std::string> files;
  bool write = false;
  bool check = false;
};
Exit format(const FmtOptions& options);

/// The language server: standard input to standard output, until it is told to exit.
Exit serveLanguage();

struct ExplainOptions : WorldOptions {
  std::string at;
};
Exit explain(const ExplainOptions& options);

struct MeshOptions : WorldOptions {
  std::string out;  ///< empty: measure only
};
Exit mesh(const MeshOptions& options);

/// What is said of a device whose meshes are not the same as all others'.
inline constexpr const char* kNotExact =
    "this device's meshes are not those of every other: take --backend cpu for a store";

struct BakeOptions : WorldOptions {
  std::string out;                  ///< the store's folder
  std::string levels = "0..4";      ///< as readLevels takes them
  std::string shard;                ///< as readShard takes it; empty: all, and merged
  bool merge = false;               ///< merge what shards have made
  uint64_t slurm = 0;               ///< so many shards as jobs of Slurm; 0: here
  std::vector<std::string> sbatch;  ///< options of these jobs
  bool detach = false;              ///< submit them, and do not wait
};
Exit bake(const BakeOptions& options);

struct StoreOptions {
  std::string store;
  std::string world;  ///< the beginning of one's name; empty: all
  bool json = false;
};
Exit storeInfo(const StoreOptions& options);
Exit storeClean(const StoreOptions& options);

/// WorldOptions: with a file, chunks of that world are baked again.
struct StoreVerifyOptions : WorldOptions {
  std::string store;
  std::string world;
  uint64_t samples = 100;
  uint64_t draw = 1;  ///< seed of what is drawn
};
Exit storeVerify(const StoreVerifyOptions& options);

struct StoreDiffOptions {
  std::string store, other;
  std::string from, to;  ///< worlds of theirs, by the beginning of their names; empty: the only ones
  bool list = false;
  bool json = false;
};
Exit storeDiff(const StoreDiffOptions& options);

struct MeasureOptions : WorldOptions {
  double weld = 0;  ///< metres
  uint32_t bins = 33;
  std::string mode = "corrected";
  double curvature_length = 1;  ///< metres
  bool unique_edges = false;
  std::optional<double> cubes;  ///< metres
  bool no_self_intersections = false;
  bool strict = false;                             ///< fail where the mesh is not valid
  std::vector<std::string> of_grammars, of_files;  ///< options that were given which only these have
  bool field = false;                              ///< also against the grammar's field
  int levels = 0;                                  ///< also so many pairs of levels, from `level` on
  bool drawing = false;                            ///< also what drawing it costs
  std::optional<double> texels;                    ///< also the texels of a texture of this resolution
  std::string against;                             ///< also the distance to this file's mesh; empty: none
  std::string from, to;                            ///< of a way through the void, points in metres; both or neither
  std::optional<double> radius;  ///< metres: of who is to go there; given, or with a way, the void is measured
  uint64_t memory = 4096;        ///< MB
  double seconds = 300;
};
Exit measureMesh(const MeasureOptions& options);

struct ClassifyOptions : WorldOptions {
  std::string masters;  ///< a base; empty: the one at its own place, or those that are built in
  std::string mode = "curvature";
  uint64_t memory = 4096;  ///< MB
  double seconds = 300;
};
Exit classifyMesh(const ClassifyOptions& options);

struct InspectOptions {
  std::string kind;        ///< "glb", "obj", "ply", "stl" or "sgm"
  std::string name;        ///< a client's, for people; may be anything
  std::string masters;     ///< a base; empty: those that are built in
  uint64_t memory = 2048;  ///< MB
  uint64_t seconds = 60;
  bool list_masters = false, store_masters = false;  ///< instead of all else
  std::string region, cell, seed;                    ///< of a grammar, as they were sent; empty: not at all
  std::vector<std::string> sets;
};
/// Standard input to standard output: uint64 size of the JSON, the JSON, uint64 size of the preview, the preview.
Exit inspect(const InspectOptions& options);

struct MastersBuildOptions {
  std::string out;   ///< empty: its own place, unless `emit` is there
  std::string emit;  ///< a source file; empty: none
  uint64_t models = 12;
  uint64_t seed = 1;
  unsigned threads = 0;
};
Exit buildMasters(const MastersBuildOptions& options);

struct MastersListOptions {
  std::string file;  ///< as ClassifyOptions::masters
  bool json = false;
};
Exit listMasters(const MastersListOptions& options);

struct RenderOptions : WorldOptions {
  std::string out;
  std::string camera;
  std::string at;
  std::string size = "1280x720";
  double fov = 68;
  std::optional<double> pixels;        ///< how wide a cell may look, where that asks for smaller ones
  std::string light = "auto";          ///< sun, lamp, none, or auto: what the camera sees decides
  bool volume = false;                 ///< the solid as fog instead of its surface
  bool wires = false;                  ///< the mesh's edges, without materials
  std::string frame;                   ///< a rule, or a path of uses, one of which the camera shows; empty: none
  std::string seeds;                   ///< of a contact sheet, as readSeeds takes them; empty: one picture of `seed`
  bool plan = false;                   ///< a survey's plan in place of a picture
  std::optional<std::string> section;  ///< a long section: "" or as survey::readCutLine takes it
};
/// A picture, a contact sheet or a survey.
Exit render(const RenderOptions& options);

/// A window, until its user closes it. Of the options, those of one picture count.
Exit showPreview(const RenderOptions& options);

struct FlyOptions : WorldOptions {
  std::string path;  ///< a JSON file; empty: the flight finds its own way
  double speed = 20;
  uint64_t frames = 600;
  uint64_t teleports = 0;
  double edits = 0;                   ///< digs a second of the path
  bool animate = false;               ///< drive parameters while flying
  std::vector<std::string> animated;  ///< these; none: all that the grammar declares animated
  bool check = false, unpaced = false, compare = false;
  bool measure = false;  ///< every chunk that is meshed
  int top_level = 6;
  double finest = 24, finest_margin = 6, view = 600;  ///< metres
  uint64_t mesh_mb = 256;
  uint64_t pictures = 0;
  std::string out = "flight.png";
  std::string light = "auto";  ///< of pictures, as RenderOptions::light
  bool levels = false;
  std::string video;                ///< an .mp4 file; empty: none
  std::string journal, cache;       ///< a file and a folder of the world's; empty: none
  std::vector<std::string> stores;  ///< folders of baked worlds
  bool serve = false, keep_serving = false;
  ServingOptions serving;  ///< where `serve` is set
};
Exit fly(const FlyOptions& options);

struct BenchOptions {
  uint64_t runs = 10;
  std::vector<std::string> backends;  ///< none: all that `auto` might choose
  unsigned threads = 0;
  uint64_t cells = 256;        ///< on the edge of a stage's cube
  std::optional<double> cell;  ///< metres, instead
  bool json = false;
};
Exit benchPaper(const BenchOptions& options);

struct BenchChunksOptions : WorldOptions {
  uint64_t runs = 5;
};
Exit benchChunks(const BenchChunksOptions& options);

struct PaperOptions {
  std::string out;
  std::vector<std::string> only;  ///< parts of the report; none: all
  bool quick = false;
  bool no_pictures = false;
  std::string backend = "auto";
  unsigned threads = 0;
  uint64_t seed = 1;
  bool json = false;
};
/// What --only may name, in the order of the report.
std::vector<std::string> paperParts();
Exit reproducePaper(const PaperOptions& options);

struct ServeOptions {
  ServingOptions serving;
  bool json = false;
};
Exit serve(const ServeOptions& options);

Exit listBackends(bool json);

/// Reads the command line and runs what it asks for.
Exit runCommandLine(int argc, char** argv);

}  // namespace sgm::cli
