#include "tools/language/lsp_text.h"

#include <algorithm>

namespace sgm::cli {
namespace {

/// Number of bytes of the character at the start of `rest`; 1 for invalid UTF-8.
uint32_t bytesOf(std::string_view rest) {
  const auto first = static_cast<unsigned char>(rest[0]);
  const uint32_t bytes = first < 0xC0 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  return std::min(bytes, static_cast<uint32_t>(rest.size()));
}

constexpr uint32_t kBetweenMarks = 256;  // bytes between two marks (offsets with a known column) in a long line

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

DocumentText::DocumentText(std::string text) : text_(std::move(text)), lines_{0}, rows_{0} {
  for (uint32_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\n') rows_.push_back(i + 1);
    const bool pair = text_[i] == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n';
    if (text_[i] == '\n' || (text_[i] == '\r' && !pair)) lines_.push_back(i + 1);
  }
  for (size_t line = 0; line < lines_.size(); ++line) {
    const size_t end = line + 1 < lines_.size() ? lines_[line + 1] : text_.size();
    Mark here{lines_[line], 0};
    marks_.push_back(here);
    while (here.at < end) {
      step(here.at, here.character);
      if (here.at >= marks_.back().at + kBetweenMarks && here.at < end) marks_.push_back(here);
    }
  }
}

void DocumentText::step(uint32_t& at, uint32_t& character) const {
  const uint32_t bytes = bytesOf(std::string_view(text_).substr(at));
  character += bytes == 4 ? 2 : 1;
  at += bytes;
}

TextPosition DocumentText::position(uint32_t offset) const {
  offset = std::min(offset, static_cast<uint32_t>(text_.size()));
  const auto line = static_cast<uint32_t>(std::upper_bound(lines_.begin(), lines_.end(), offset) - lines_.begin() - 1);
  const auto behind = std::upper_bound(marks_.begin(), marks_.end(), offset,
                                       [](uint32_t place, const Mark& mark) { return place < mark.at; });
  Mark here = *(behind - 1);
  while (here.at < offset) step(here.at, here.character);
  return {line, here.character};
}

uint32_t DocumentText::endOf(const std::vector<uint32_t>& lines, uint32_t line) const {
  if (line + 1 >= lines.size()) return static_cast<uint32_t>(text_.size());
  const uint32_t end = lines[line + 1] - 1;
  return end > lines[line] && text_[end] == '\n' && text_[end - 1] == '\r' ? end - 1 : end;
}

uint32_t DocumentText::offset(TextPosition position) const {
  if (position.line >= lines_.size()) return static_cast<uint32_t>(text_.size());
  const uint32_t end = endOf(lines_, position.line);
  Mark here{lines_[position.line], 0};
  while (here.at < end && here.character < position.character) step(here.at, here.character);
  return std::min(here.at, end);
}

uint32_t DocumentText::offsetOf(int line, int column) const {
  if (line < 1) return 0;
  const auto row = static_cast<uint32_t>(line - 1);
  if (row >= rows_.size()) return static_cast<uint32_t>(text_.size());
  return std::min(rows_[row] + static_cast<uint32_t>(std::max(column - 1, 0)), endOf(rows_, row));
}

std::string pathOfUri(std::string_view uri) {
  constexpr std::string_view kFile = "file://";
  if (!uri.starts_with(kFile)) return {};
  uri.remove_prefix(kFile.size());
  // Skip the host name, which is localhost or empty: it is not part of the path.
  uri.remove_prefix(std::min(uri.find('/'), uri.size()));
  std::string path;
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hexDigit(uri[i + 1]) >= 0 && hexDigit(uri[i + 2]) >= 0) {
      path += static_cast<char>(hexDigit(uri[i + 1]) * 16 + hexDigit(uri[i + 2]));
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

std::string uriOfPath(std::string_view path) {
  constexpr std::string_view kPlain = "/-._~", kHex = "0123456789ABCDEF";
  std::string uri = "file://";
  for (const char c : path) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    const auto byte = static_cast<unsigned char>(c);
    if (letter || kPlain.find(c) != std::string_view::npos)
      uri += c;
    else
      uri.append({'%', kHex[byte >> 4], kHex[byte & 15]});
  }
  return uri;
}

}  // namespace sgm::cli
