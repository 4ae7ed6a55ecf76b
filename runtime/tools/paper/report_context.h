#pragma once
// Resources that all parts of the report share: the embedded grammars, a renderer, and the pictures drawn so far.

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
  /// renderer: null if no pictures are to be drawn. The options, jobs and renderer must outlive the report context.
  ReportContext(const PaperOptions& options, JobSystem& jobs, const Renderer* renderer)
      : options_(options), jobs_(jobs), renderer_(renderer) {}

  const PaperOptions& options() const { return options_; }
  JobSystem& jobs() const { return jobs_; }
  /// Returns `quick` if the option --quick is given, otherwise `full`.
  template <class T>
  T pick(T full, T quick) const {
    return options_.quick ? std::move(quick) : std::move(full);
  }
  /// Sets the label of the following progress bars.
  void begin(std::string doing) { doing_ = std::move(doing); }
  const std::string& doing() const { return doing_; }

  /// Makes options for one of the embedded grammars, with the backend and threads of the report.
  template <class Options = WorldOptions>
  Options on(const std::string& grammar) const {
    Options options;
    options.file = kGrammars + grammar;
    options.backend = options_.backend;
    options.threads = options_.threads;
    return options;
  }
  /// The name of the embedded grammar in options that on() has made.
  static std::string grammarOf(const WorldOptions& options) { return options.file.substr(kGrammars.size()); }

  /// Meshes the region that the options select. texture: also computes texture coordinates. Errors: those of
  /// meshProgram(); bad_input if there is no surface.
  Result<Region> mesh(const WorldOptions& options, bool texture = false) const;
  /// Meshes the region that the options select, and measures the welded mesh as `sgm measure` does for regions.
  Result<measure::MeshMeasures> measure(const MeasureOptions& options) const;

  /// Draws a picture and stores it as pictures/NAME.png. Returns an HTML figure with the picture and its caption, and
  /// appends the command line that repeats the picture to `commands`. Returns an empty markup if no pictures are to be
  /// drawn. alt: text alternative for readers who cannot see the picture.
  Result<Markup> picture(RenderOptions options, const std::string& name, const std::string& alt,
                         const std::string& caption, std::vector<std::string>& commands);
  /// Arranges pictures side by side.
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
