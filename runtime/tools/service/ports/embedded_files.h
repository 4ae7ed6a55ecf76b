#pragma once
// The files of the web page and the description of the HTTP interface, embedded in the library, so that no files are
// read at run time.

#include <span>
#include <string_view>

namespace sgm::service {

struct EmbeddedFile {
  std::string_view name;  ///< file name without its folder
  std::string_view bytes;
  std::string_view tag;  ///< entity tag (ETag) of these bytes
};

std::span<const EmbeddedFile> embeddedFiles();

}  // namespace sgm::service
