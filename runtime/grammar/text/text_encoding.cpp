#include "grammar/text/text_encoding.h"

#include <algorithm>
#include <array>

namespace sgm {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view kSave = "save it as UTF-8";
constexpr std::string_view kOther = "a grammar is a text in UTF-8 that starts with `sgm 1;`";

struct Start {
  std::string_view bytes;
  std::string_view message;
  std::string_view hint;
};

// UTF-32 is tested before UTF-16, since its little-endian byte order mark starts with that of UTF-16.
constexpr std::array kStarts = {
    Start{"\xFF\xFE\0\0"sv, "the text is UTF-32, not UTF-8", kSave},
    Start{"\0\0\xFE\xFF"sv, "the text is UTF-32, not UTF-8", kSave},
    Start{"\xFF\xFE"sv, "the text is UTF-16, not UTF-8", kSave},
    Start{"\xFE\xFF"sv, "the text is UTF-16, not UTF-8", kSave},
    Start{"glTF"sv, "this is a GLB file, not a grammar", "import it as an asset: `import \"bay.glb\" as bay;`"},
    Start{"\x89PNG"sv, "this is a PNG picture, not a grammar", kOther},
    Start{"PK\x03\x04"sv, "this is a ZIP archive, not a grammar", "unpack it"},
    Start{"\x1F\x8B"sv, "this file is compressed with gzip and is not a grammar", "unpack it"},
    Start{"\x28\xB5\x2F\xFD"sv, "this file is compressed with zstd and is not a grammar", "unpack it"},
    Start{"\x7F"
          "ELF"sv,
          "this is a program, not a grammar", kOther},
    Start{"%PDF"sv, "this is a PDF file, not a grammar", kOther},
};

/// Guesses the number of bytes per character from the zero bytes next to Latin letters: 4, 2, or 1 if neither pattern
/// fits.
size_t widthByZeros(std::string_view text) {
  constexpr size_t kLook = 4096, kLeast = 8;
  text = text.substr(0, std::min(text.size(), kLook) / 4 * 4);
  if (text.size() < kLeast) return 1;
  std::array<size_t, 4> zeros{};
  for (size_t i = 0; i < text.size(); ++i) zeros[i % 4] += text[i] == '\0' ? size_t{1} : size_t{0};
  const size_t quarters = text.size() / 4;
  const auto most = [&](size_t i) { return zeros[i] * 4 >= quarters * 3; };
  const auto few = [&](size_t i) { return zeros[i] * 4 <= quarters; };
  if ((few(0) && most(1) && most(2) && most(3)) || (most(0) && most(1) && most(2) && few(3))) return 4;
  if ((few(0) && most(1) && few(2) && most(3)) || (most(0) && few(1) && most(2) && few(3))) return 2;
  return 1;
}

}  // namespace

std::optional<EncodingFault> encodingFault(std::string_view text) {
  for (const Start& start : kStarts)
    if (text.starts_with(start.bytes)) return EncodingFault{0, start.message, start.hint};
  const size_t zero = text.find('\0');
  if (zero == std::string_view::npos) return std::nullopt;
  switch (widthByZeros(text)) {
    case 4:
      return EncodingFault{0, "the text is UTF-32, not UTF-8", kSave};
    case 2:
      return EncodingFault{0, "the text is UTF-16, not UTF-8", kSave};
    default:
      return EncodingFault{zero, "this file has a zero byte here, and a text has none", kOther};
  }
}

}  // namespace sgm
