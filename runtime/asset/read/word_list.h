#pragma once
// Constant lists of keywords of file formats.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>

namespace sgm::asset {

template <size_t N>
bool isIn(const std::string_view (&words)[N], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

}  // namespace sgm::asset
