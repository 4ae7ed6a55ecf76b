# cmake -DOUT=file.cpp -DDIR=std -DFILES=a.sgm;b.sgm -P embed_std.cmake: writes the standard library as C++ text.
set(body "")
set(count 0)
foreach(file IN LISTS FILES)
  file(READ ${DIR}/${file} text)
  # Each file must be shorter than the longest literal that compilers accept. C++ recommends a limit of at least 65,536
  # characters.
  string(APPEND body "    {\"std/${file}\", R\"sgm(${text})sgm\"},\n")
  math(EXPR count "${count} + 1")
endforeach()
file(WRITE ${OUT} "#include \"grammar/std/std_library.h\"

#include <array>

namespace sgm {

std::span<const StdFile> stdLibrary() {
  static constexpr std::array<StdFile, ${count}> kFiles = {{
${body}  }};
  return kFiles;
}

}  // namespace sgm
")
