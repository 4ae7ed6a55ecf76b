#pragma once
// The page's files and the description of the interface, embedded in the library: no files are read at run time.

#include <span>
#include <string_view>

namespace sgm::service {

struct EmbeddedFile {
  std::string_view name;  ///< without a folder
  std::string_view bytes;
  std::string_view tag;  ///< the ETag of these bytes
};

std::span<const EmbeddedFile> embeddedFiles();

}  // namespace sgm::service
