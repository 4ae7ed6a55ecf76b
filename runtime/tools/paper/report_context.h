#pragma once
// Resources that the report's parts share: the embedded grammars, a renderer, and the pictures drawn so far.

#include <string>
#include <vector>

#include "measure/mesh_measures.h"
#include "tools/cli/measure/commands.h"
#include "tools/paper/commands.h"
#include "tools/paper/folder.h"
#include "tools/paper/report_item.h"
#include "tools/render/renderer.h"
#include "tools/support/options.h"
#include "tools/support/region.h"
#include "tools/support/render_options.h"

namespace sgm::cli {

class ReportContext {
 public:
  /// renderer: null if no pictures are drawn. The options, jobs and renderer must outlive the workshop.
  ReportContext(const PaperOptions& options, JobSystem& jobs, const Renderer* renderer)
      : options_(options), jobs_(jobs), renderer_(renderer) {}

  const PaperOptions& options() const { return options_; }
  JobSystem& jobs() const { return jobs_; }
  /// Returns `quick` for a quick report, otherwise `full`.
  template <class T>
  T pick(T full, T quick) const {
    return options_.quick ? std::move(quick) : std::move(full);
  }
  /// Sets the text beside the following progress bars.
  void begin(std::string doing) { doing_ = std::move(doing); }
  const std::string& doing() const { return doing_; }

  /// Options for one of the embedded grammars, with the report's own backend and threads.
  template <class Options = WorldOptions>
  Options on(const std::string& grammar) const {
    Options options;
    options.file = kGrammars + grammar;
    options.backend = options_.backend;
    options.threads = options_.threads;
    return options;
  }
  /// The name of the embedded grammar in options that on() has returned.
  static std::string grammarOf(const WorldOptions& options) { return options.file.substr(kGrammars.size()); }

  /// Meshes the region of the options. texture: also computes texture coordinates. Errors: as meshProgram(); bad_input
  /// if there is no surface.
  Result<Region> mesh(const WorldOptions& options, bool texture = false) const;
  /// Measures the welded mesh of a region with point sampling, as `sgm measure` does.
  Result<measure::MeshMeasures> measure(const MeasureOptions& options) const;

  /// Draws a picture and stores it as pictures/NAME.png. Returns the HTML element with caption and command line, and
  /// appends the command line to `commands`. Returns an empty markup if no pictures are drawn. alt: description of the
  /// picture for readers who cannot see it.
  Result<Markup> picture(RenderOptions options, const std::string& name, const std::string& alt,
                         const std::string& caption, std::vector<std::string>& commands);
  /// Places pictures side by side.
  static Markup row(const Markup& pictures) { return element("div", {{"class", "row"}}, pictures) + Markup{"\n"}; }

  const std::vector<FolderFile>& pictures() const { return pictures_; }

 private:
  static inline const std::string kGrammars = "grammars/";

  const PaperOptions& options_;
  JobSystem& jobs_;
  const Renderer* renderer_;
  std::string doing_;
  std::vector<FolderFile> pictures_;
};

/// The command line that makes only this part of the report.
std::string commandOfPart(const PaperOptions& options, const std::string& part);

}  // namespace sgm::cli
