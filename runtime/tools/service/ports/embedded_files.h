#pragma once
// The files of the web page and the description of the HTTP interface, embedded in the library: the service reads no
// files for them at run time.

#include <span>
#include <string_view>

namespace sgm::service {

struct EmbeddedFile {
  std::string_view name;  ///< file name without directory
  std::string_view bytes;
  std::string_view tag;  ///< entity tag (ETag) of the file's content
};

std::span<const EmbeddedFile> embeddedFiles();

}  // namespace sgm::service
