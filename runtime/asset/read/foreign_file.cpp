#include "asset/read/foreign_file.h"

#include <utility>

#include "asset/read/text_reader.h"

namespace sgm::asset {

std::string_view foreignFile(std::span<const std::byte> bytes) {
  constexpr std::pair<std::string_view, std::string_view> kBeginnings[] = {
      {"\x89PNG", "a PNG picture, not a mesh"},
      {"\xFF\xD8\xFF", "a JPEG picture, not a mesh"},
      {"GIF8", "a GIF picture, not a mesh"},
      {"%PDF", "a PDF document, not a mesh"},
      {"PK\x03\x04", "a ZIP archive (such as .zip, .3mf or .usdz), not a mesh file by itself"},
      {"\x1F\x8B", "compressed by gzip, not a mesh file by itself"},
      {"\x28\xB5\x2F\xFD", "compressed by Zstandard (as new .blend files are), not a mesh file by itself"},
      {"7z\xBC\xAF", "a 7z archive, not a mesh file by itself"},
      {"Rar!", "a RAR archive, not a mesh file by itself"},
      {"Kaydara FBX Binary", "an FBX file, which sgm does not read"},
      {"; FBX", "an FBX file, which sgm does not read"},
      {"BLENDER", "a Blender file, which sgm does not read"},
      {"PXR-USDC", "a USD file, which sgm does not read"},
      {"#usda", "a USD file, which sgm does not read"},
      {"ISO-10303-21", "a STEP file, which sgm does not read"},
      {"#VRML", "a VRML file, which sgm does not read"},
      {"version https://git-lfs", "a Git LFS pointer, not the file itself: run `git lfs pull`"},
  };
  constexpr std::pair<std::string_view, std::string_view> kFirstWords[] = {
      {"OFF", "an OFF file, which sgm does not read"},
      {"COFF", "an OFF file, which sgm does not read"},
      {"NOFF", "an OFF file, which sgm does not read"},
      {"sgm", "a grammar (.sgm), not a mesh file"},
      {"<?xml", "an XML file (such as COLLADA or X3D), which sgm does not read"},
      {"<COLLADA", "a COLLADA file, which sgm does not read"},
      {"<!DOCTYPE", "a web page, not a mesh"},
      {"<!doctype", "a web page, not a mesh"},
      {"<html", "a web page, not a mesh"},
      {"<html>", "a web page, not a mesh"},
  };
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const auto& [beginning, what] : kBeginnings)
    if (text.starts_with(beginning)) return what;
  const std::string_view word = TextReader(text).wordOfAnyLine();
  for (const auto& [first, what] : kFirstWords)
    if (word == first) return what;
  return {};
}

}  // namespace sgm::asset
