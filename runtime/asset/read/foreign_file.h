#pragma once
// Files that are no meshes, or meshes that this library does not read, told by how they begin.

#include <cstddef>
#include <span>
#include <string_view>

namespace sgm::asset {

/// Such as "a PNG picture"; empty if it is not one of those that people mistake for meshes.
std::string_view foreignFile(std::span<const std::byte> bytes);

}  // namespace sgm::asset
