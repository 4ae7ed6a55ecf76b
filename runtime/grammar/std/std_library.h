#pragma once
// The standard library: the .sgm files of this folder, embedded in the binary at build time.

#include <span>
#include <string_view>

namespace sgm {

struct StdFile {
  std::string_view path;  ///< path under which grammars import the file, such as "std/rock.sgm"
  std::string_view text;
};

/// Returns all files of the library, sorted by path.
std::span<const StdFile> stdLibrary();

/// Returns the text of the file "std/NAME.sgm"; an empty view if the library has no such file.
std::string_view standardModule(std::string_view path);

}  // namespace sgm
