# Writes the SPIR-V words of the file INPUT to the header OUTPUT, as a C++ array named SYMBOL.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1u," words "${bytes}")
string(REGEX REPLACE "(0x........u,0x........u,0x........u,0x........u,0x........u,0x........u,0x........u,0x........u,)"
  "\\1\n    " words "${words}")
file(WRITE ${OUTPUT}
  "#pragma once\n#include <cstdint>\n\nnamespace sgm::spirv {\n"
  "inline constexpr std::uint32_t ${SYMBOL}[] = {\n    ${words}};\n}  // namespace sgm::spirv\n")
