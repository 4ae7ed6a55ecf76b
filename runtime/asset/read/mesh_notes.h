#pragma once
// Notes of a mesh reader for the user: sentences about parts of a file that it left out, or that violate the format.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sgm::asset {

/// Counts the occurrences of one kind of problem, and stores the place of the first occurrence.
struct NotedPlaces {
  size_t count = 0;
  std::string first;  ///< place of the first occurrence, such as "line 12"

  /// Counts one occurrence. place: a function that returns its place as text; called for the first occurrence only.
  template <class Place>
  void add(const Place& place) {
    if (count++ == 0) first = place();
  }
};

/// Formats a number with its noun in singular or plural: "1 line", "3 lines".
inline std::string counted(size_t count, std::string_view one, std::string_view several) {
  return std::to_string(count).append(" ").append(count == 1 ? one : several);
}

/// Appends a note such as "3 lines are left out, the first at line 9: behind", if `places` has counted any. one,
/// several: noun and verb of the note in singular and plural; behind: text that ends the note.
inline void addNote(std::vector<std::string>& notes, const NotedPlaces& places, std::string_view one,
                    std::string_view several, std::string_view behind = {}) {
  if (places.count == 0) return;
  std::string text = counted(places.count, one, several);
  if (!places.first.empty()) text.append(places.count == 1 ? ", at " : ", the first at ").append(places.first);
  notes.push_back(text.append(behind));
}

inline std::string lineText(size_t line) { return "line " + std::to_string(line); }
inline std::string byteText(size_t byte) { return "byte " + std::to_string(byte); }

}  // namespace sgm::asset
