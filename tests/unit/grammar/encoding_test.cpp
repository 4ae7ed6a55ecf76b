// Tests files that are not UTF-8 text: each must give one error that names the cause.

#include <string>
#include <string_view>

#include "messages.h"

using namespace sgm;
using namespace sgm::test;

namespace {

using namespace std::string_literals;

constexpr std::string_view kText = "sgm 1;\nstart A;\nrule A { sphere(1m); } // of chalk\n";

/// Encodes text with `width` bytes for each character, in little-endian or big-endian order.
std::string widened(std::string_view text, size_t width, bool little, std::string_view mark = {}) {
  std::string out(mark);
  for (const char c : text) {
    std::string one(width, '\0');
    one[little ? 0 : width - 1] = c;
    out += one;
  }
  return out;
}

std::string saidOfBytes(const std::string& bytes) { return inWords(compileText(bytes)); }

constexpr const char* kUtf16 = "1:1 bad-character: the text is UTF-16, not UTF-8 | save it as UTF-8";
constexpr const char* kUtf32 = "1:1 bad-character: the text is UTF-32, not UTF-8 | save it as UTF-8";
constexpr const char* kWhat = " | a grammar is a text in UTF-8 that starts with `sgm 1;`";

}  // namespace

TEST_CASE("UTF-16 and UTF-32 are named, with a byte order mark and without", "[grammar][encoding]") {
  CHECK(saidOfBytes(widened(kText, 2, true, "\xFF\xFE")) == kUtf16);
  CHECK(saidOfBytes(widened(kText, 2, false, "\xFE\xFF")) == kUtf16);
  CHECK(saidOfBytes(widened(kText, 2, true)) == kUtf16);
  CHECK(saidOfBytes(widened(kText, 2, false)) == kUtf16);
  CHECK(saidOfBytes(widened(kText, 4, true, "\xFF\xFE\0\0"s)) == kUtf32);
  CHECK(saidOfBytes(widened(kText, 4, false, "\0\0\xFE\xFF"s)) == kUtf32);
  CHECK(saidOfBytes(widened(kText, 4, true)) == kUtf32);
  CHECK(saidOfBytes(widened(kText, 4, false)) == kUtf32);
  CHECK(saidOfBytes("\xFF\xFE") == kUtf16);
}

TEST_CASE("UTF-8 may begin with a byte order mark", "[grammar][encoding]") {
  CHECK(saidOfBytes("\xEF\xBB\xBF" + std::string(kText)).empty());
}

TEST_CASE("files of other kinds are named", "[grammar][encoding]") {
  CHECK(saidOfBytes("glTF\x02\0\0\0rest"s) ==
        "1:1 bad-character: this is a GLB file, not a grammar | import it as an asset: `import \"bay.glb\" as bay;`");
  CHECK(saidOfBytes("\x89PNG\r\n"s) == "1:1 bad-character: this is a PNG picture, not a grammar"s + kWhat);
  CHECK(saidOfBytes("PK\x03\x04..") == "1:1 bad-character: this is a ZIP archive, not a grammar | unpack it");
  CHECK(saidOfBytes("\x1F\x8B..") ==
        "1:1 bad-character: this file is compressed with gzip and is not a grammar | unpack it");
  CHECK(saidOfBytes("\x28\xB5\x2F\xFD..") ==
        "1:1 bad-character: this file is compressed with zstd and is not a grammar | unpack it");
  CHECK(saidOfBytes("\x7F"
                    "ELF..") == "1:1 bad-character: this is a program, not a grammar"s + kWhat);
  CHECK(saidOfBytes("%PDF-1.7") == "1:1 bad-character: this is a PDF file, not a grammar"s + kWhat);
  CHECK(saidOfBytes("sgm 1;\nstart A;\0 rule A { }"s) ==
        "2:9 bad-character: this file has a zero byte here, and a text has none"s + kWhat);
}

TEST_CASE("bytes that are not UTF-8 are told once a file, with their number", "[grammar][encoding]") {
  CHECK(saidOfBytes("sgm 1; start A;\nrule A { sphere(1m); } // M\xFCnchen\n// Br\xFC"
                    "cke\n// \xE4\n") ==
        "2:28 bad-character: this byte is not UTF-8 | save the file as UTF-8 | note: 2 more bytes of this file are not "
        "UTF-8");
  CHECK(saidOfBytes("sgm 1; start A;\nrule A { sphere(1m); mat stra\xDF"
                    "e\xE4; }") ==
        "2:30 bad-character: this byte is not UTF-8 | save the file as UTF-8 | note: 1 more byte of this file is not "
        "UTF-8");
  CHECK(formatGrammar(widened(kText, 2, true), "a.sgm").diagnostics.size() == 1);
}

TEST_CASE("an import in another encoding is told once, and its names are not missed", "[grammar][encoding]") {
  MapResolver files;
  files.files["parts.sgm"] = widened("sgm 1; rule Post { sphere(1m); }", 2, true);
  const CompileResult result =
      compileText("sgm 1; import \"parts.sgm\" as parts; start A; rule A { parts.Post; box(1); }", &files);
  CHECK(inWords(result) ==
        "1:71 unit-mismatch: the edge of a box is a length, and this is a ratio | write `1m`\n"s + kUtf16);
}
