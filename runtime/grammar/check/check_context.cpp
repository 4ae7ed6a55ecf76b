#include "grammar/check/check_context.h"

#include "grammar/text/codes.h"

namespace sgm {

IdRange CheckContext::store(const std::vector<uint32_t>& ids) const {
  const IdRange range{static_cast<uint32_t>(program.ast.ids.size()), static_cast<uint32_t>(ids.size())};
  program.ast.ids.insert(program.ast.ids.end(), ids.begin(), ids.end());
  return range;
}

uint16_t CheckContext::tableIndex(std::pmr::vector<std::pmr::string>& table, NameId name, const Span& span) const {
  const std::string_view word = text(name);
  for (size_t i = 0; i < table.size(); ++i)
    if (table[i] == word) return static_cast<uint16_t>(i);
  constexpr size_t kMost = 4096;
  if (table.size() >= kMost) {
    sink.error(span, codes::kTooLarge, "the program has more than 4096 different names of one kind",
               "materials, tags and anchors may have that many names each; use some names again");
    return 0;
  }
  table.emplace_back(word);
  return static_cast<uint16_t>(table.size() - 1);
}

}  // namespace sgm
