#include "grammar/syntax/override_path.h"

#include <charconv>

#include "grammar/syntax/ast.h"

namespace sgm {

namespace {

class PathReader {
 public:
  explicit PathReader(std::string_view text) : text_(text) {}

  WrittenPath run() {
    do {
      const uint32_t begin = at_;
      const std::string_view first = name();
      if (out_.steps.empty() && out_.layer.empty() && next() == '(') {
        out_.layer = first;
        out_.layer_place = {begin, at_};
        cell();
        if (next() != '/') want("`/` and a rule after the cell");
        continue;
      }
      WrittenStep step{{}, first, {}, {}};
      if (accept('.')) {
        step.qualifier = first;
        step.name = name();
      }
      if (accept('[')) {
        const uint32_t begin_number = at_;
        step.index = number<uint32_t>("the number of a use, such as 0");
        if (step.index == kNoId) {
          at_ = begin_number;
          want("the number of a use, such as 0");
        }
        if (!accept(']')) want("`]`");
      }
      step.place = {begin, at_};
      out_.steps.push_back(step);
    } while (out_.wanted.empty() && accept('/'));
    if (at_ < text_.size()) want("`/` between two steps, or the end of the path");
    return std::move(out_);
  }

 private:
  char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  bool accept(char c) {
    if (next() != c) return false;
    ++at_;
    return true;
  }

  void blanks() {
    while (accept(' ')) {
    }
  }

  void want(std::string_view what) {
    if (!out_.wanted.empty()) return;
    out_.wanted = what;
    const auto size = static_cast<uint32_t>(text_.size());
    out_.wrong = {at_, at_ < size ? at_ + 1 : size};
  }

  std::string_view name() {
    const uint32_t begin = at_;
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    while (letter(next()) || (at_ > begin && next() >= '0' && next() <= '9')) ++at_;
    if (at_ == begin) want("the name of a rule");
    return text_.substr(begin, at_ - begin);
  }

  template <class T>
  T number(std::string_view what) {
    T value{};
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc{})
      want(what);
    else
      at_ = static_cast<uint32_t>(end - text_.data());
    return value;
  }

  void cell() {
    const uint32_t begin = at_++;
    for (size_t axis = 0; axis < 3; ++axis) {
      blanks();
      out_.cell[axis] = number<int32_t>("the three whole numbers of a cell, such as (0, 0, -1)");
      blanks();
      if (!accept(axis < 2 ? ',' : ')')) want("the three whole numbers of a cell, such as (0, 0, -1)");
    }
    out_.cell_place = {begin, at_};
  }

  std::string_view text_;
  uint32_t at_ = 0;
  WrittenPath out_;
};

}  // namespace

WrittenPath parsePath(std::string_view text) { return PathReader(text).run(); }

}  // namespace sgm
