#pragma once
// Recognises, by their first bytes, files that are not meshes, and meshes in an unsupported format.

#include <cstddef>
#include <span>
#include <string_view>

namespace sgm::asset {

/// Returns a description of the format, such as "a PNG picture"; empty if the bytes are of no format that users
/// commonly mistake for a supported mesh.
std::string_view foreignFile(std::span<const std::byte> bytes);

}  // namespace sgm::asset
