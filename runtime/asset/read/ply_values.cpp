#include "asset/read/ply_values.h"

#include <algorithm>
#include <cstdint>

namespace sgm::asset {

PlyTextValues::Counts PlyTextValues::counts() const {
  Counts counts;
  for (const PlyElement& element : header_.elements)
    if (!element.properties.empty()) counts.records += std::min<uint64_t>(element.count, UINT32_MAX);
  TextReader all = all_;
  do counts.lines += uint64_t{!all.isLineDone()};
  while (all.nextLine());
  return counts;
}

bool PlyTextValues::hasSpareLines() const {
  const Counts all = counts();
  return all.lines > all.records;
}

/// Decides, by counting lines, whether each line is a record or line ends have no meaning. Called when a line has more
/// or fewer values than its record for the first time.
void PlyTextValues::findLayout() {
  if (layout_ != Layout::unknown) return;
  const auto [records, lines] = counts();
  layout_ = lines >= records ? Layout::lines : Layout::words;
  line_a_record_ = lines == records;
}

bool PlyTextValues::mayWrap() {
  findLayout();
  wrapped_ = true;
  if (line_a_record_) problem_ = "a line has fewer values than the header declares";
  return !line_a_record_;
}

bool PlyTextValues::passSurplus() {
  findLayout();
  if (layout_ == Layout::words) return true;
  if (wrapped_) {
    problem_ = "a line has more values than the header declares, after one with fewer";
    return false;
  }
  surplus_.add([&] { return lineText(header_.lines + text_.line()); });
  text_.rest();
  return true;
}

Result<void> PlyTextValues::end(bool whole, std::vector<std::string>& notes) {
  const bool more = whole && !text_.wordOfAnyLine().empty();
  if (more && layout_ == Layout::words) return wrong("it has more values than the header declares");
  addNote(notes, surplus_, "line has more values than the header declares",
          "lines have more values than the header declares", ": left out");
  if (more) notes.push_back("text after its last element is left out, at " + lineText(header_.lines + text_.line()));
  return {};
}

}  // namespace sgm::asset
