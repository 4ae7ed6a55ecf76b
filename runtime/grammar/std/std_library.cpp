#include "grammar/std/std_library.h"

namespace sgm {

std::string_view standardModule(std::string_view path) {
  for (const StdFile& file : stdLibrary())
    if (file.path == path) return file.text;
  return {};
}

}  // namespace sgm
