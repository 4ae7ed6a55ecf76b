#pragma once
// Reads the numbers in the body of a PLY text file, one after another.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asset/read/mesh_limits.h"
#include "asset/read/mesh_notes.h"
#include "asset/read/ply_header.h"
#include "asset/read/text_reader.h"
#include "base/result.h"

namespace sgm::asset {

/// Reads the numbers of a PLY text file one after another. Usually each line is one record (one element), and
/// undeclared values at the end of a line are skipped. If the text has fewer lines than records, line ends have no
/// meaning.
class PlyTextValues {
 public:
  static constexpr std::string_view kUnit = "line";

  PlyTextValues(std::string_view file, const PlyHeader& header)
      : text_(file.substr(header.bytes)), all_(text_), header_(header) {}

  void beginRecord() {
    begun_ = wrapped_ = false;
    place_ = 0;
  }
  bool take(PlyType, double& out) {
    std::string_view word = text_.word();
    if (word.empty()) {
      if (begun_ && !mayWrap()) return false;
      word = text_.wordOfAnyLine();
    }
    if (!begun_) {
      begun_ = true;
      place_ = header_.lines + text_.line();
    }
    const std::optional<double> value = numberIn(word);
    if (!value) problem_ = word.empty() ? "it ends" : "it has " + shown(word) + ", which is not a number,";
    out = value.value_or(0);
    return value.has_value();
  }
  /// Ends a record. Returns false if this line has more values than expected although an earlier line had too few: then
  /// it is not clear which values belong to which record.
  bool endRecord() { return text_.isLineDone() || passSurplus(); }
  /// Returns an upper bound for the number of elements that the rest of the file can contain: each number takes at
  /// least a digit and a blank.
  size_t most(const PlyElement& element) const { return (text_.bytesLeft() + 1) / (2 * element.properties.size()); }
  const std::string& problem() const { return problem_; }
  Error wrong(std::string_view what) const { return wrongAtLine(what, header_.lines + text_.line()); }
  /// Returns the number of the line on which the current record began.
  size_t place() const { return place_; }
  /// True if all elements must be read: line ends have no meaning, so only the total number of values tells whether the
  /// body matches the header.
  bool mustReadAll() const { return layout_ == Layout::words; }
  /// True if the body has more lines than the number of records that the header declares.
  bool hasSpareLines() const;
  /// Adds notes after the last read. whole: all elements were read. Error: bad_input if there are more values than the
  /// header declares, and their meaning is ambiguous.
  Result<void> end(bool whole, std::vector<std::string>& notes);

 private:
  enum class Layout { unknown, lines, words };

  struct Counts {
    uint64_t records = 0, lines = 0;
  };
  Counts counts() const;
  bool mayWrap();
  bool passSurplus();
  void findLayout();

  TextReader text_;
  const TextReader all_;
  const PlyHeader& header_;
  Layout layout_ = Layout::unknown;
  bool line_a_record_ = false;  ///< true if the body has as many lines as records, so that each line is one record
  bool begun_ = false, wrapped_ = false;
  size_t place_ = 0;
  std::string problem_;
  NotedPlaces surplus_;
};

}  // namespace sgm::asset
