#pragma once
// Recognises by their first bytes files that are not meshes, or meshes that this library does not read.

#include <cstddef>
#include <span>
#include <string_view>

namespace sgm::asset {

/// Such as "a PNG picture"; empty if it is not a format that users commonly mistake for a mesh.
std::string_view foreignFile(std::span<const std::byte> bytes);

}  // namespace sgm::asset
