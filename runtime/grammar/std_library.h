#pragma once
// The standard library: the files of runtime/grammar/std, put into the program text at build time.

#include <span>
#include <string_view>

namespace sgm {

struct StdFile {
  std::string_view path;  ///< "std/rock.sgm"
  std::string_view text;
};

std::span<const StdFile> stdLibrary();

}  // namespace sgm
