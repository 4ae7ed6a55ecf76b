#include "tools/paper/command_line.h"
#include "tools/cli/measure/commands.h"
#include "tools/support/render_options.h"

#include <fmt/core.h>

namespace sgm::cli {

std::string commandOf(const std::string& name, const WorldOptions& options) {
  std::string line = fmt::format("sgm {} {}", name, options.file);
  if (options.seed != 0) line += fmt::format(" --seed {}", options.seed);
  for (const std::string& set : options.sets) line += " --set " + set;
  // Join option and value with '=', because a value that begins with a minus sign would be parsed as an option.
  if (!options.region.empty()) line += " --region=" + options.region;
  if (options.cell) line += fmt::format(" --cell {}", *options.cell);
  if (options.density) line += fmt::format(" --ld {}", *options.density);
  if (options.level != 0) line += fmt::format(" --level {}", options.level);
  if (options.sharp) line += " --sharp";
  if (options.uv) line += " --uv";
  if (options.backend != WorldOptions{}.backend) line += " --backend " + options.backend;
  if (options.threads != 0) line += fmt::format(" --threads {}", options.threads);
  if (options.json) line += " --json";
  return line;
}

std::string commandOf(const RenderOptions& options) {
  std::string line = commandOf("render", options);
  if (!options.camera.empty()) line += " --camera=" + options.camera;
  if (options.fov != RenderOptions{}.fov) line += fmt::format(" --fov {}", options.fov);
  if (options.light != RenderOptions{}.light) line += " --light " + options.light;
  if (options.wires) line += " --wires";
  if (options.volume) line += " --volume";
  return line + fmt::format(" --size {} --out {}", options.size, options.out);
}

std::string commandOf(const MeasureOptions& options) {
  std::string line = commandOf("measure", options);
  if (options.mode != MeasureOptions{}.mode) line += " --mode " + options.mode;
  if (options.cubes) line += fmt::format(" --cubes {}", *options.cubes);
  if (options.no_self_intersections) line += " --no-self-intersections";
  return line;
}

}  // namespace sgm::cli
