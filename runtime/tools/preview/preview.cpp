// `sgm preview`: shows a grammar in a window while the grammar is being written.

#include "tools/preview/commands.h"
#include "tools/preview/session.h"
#include "tools/support/console.h"
#include "tools/support/render_options.h"
#include "tools/support/source.h"

namespace sgm::cli {

Exit showPreview(const RenderOptions& options) {
  // Report an unreadable file at once; errors in the text of the grammar are shown in the window instead.
  if (const Result<std::string> text = readGrammarText(options.file); !text) return reportError(text.error());
  if (!options.region.empty()) {
    if (const Result<IntBox> box = parseRegion(options.region); !box) return reportError(box.error());
  }
  if (const Result<int32_t> cell = cellUnits(options); !cell) return reportError(cell.error());
  const PictureSize size = *readSize(options.size);
  const Result<std::unique_ptr<preview::Window>> window =
      preview::Window::open(options.file + " - sgm preview", size.width, size.height);
  if (!window) return reportError(window.error());
  const Result<std::unique_ptr<preview::Painter>> painter = preview::Painter::create();
  if (!painter) return reportError(painter.error());
  preview::Session session(options, **painter, **window);
  if (const Result<void> done = session.run(); !done) return reportError(done.error());
  return Exit::done;
}

}  // namespace sgm::cli
