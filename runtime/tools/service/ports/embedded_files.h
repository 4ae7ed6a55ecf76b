#pragma once
// The page's files and the description of the interface, which are a part of the library: it reads none at run time.

#include <span>
#include <string_view>

namespace sgm::service {

struct EmbeddedFile {
  std::string_view name;  ///< without a folder
  std::string_view bytes;
  std::string_view tag;  ///< of these bytes, as an ETag has it
};

std::span<const EmbeddedFile> embeddedFiles();

}  // namespace sgm::service
