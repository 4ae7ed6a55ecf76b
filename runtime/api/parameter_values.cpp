#include "api/parameter_values.h"

#include <algorithm>
#include <memory_resource>
#include <string>

#include "grammar/syntax/lexer.h"
#include "grammar/text/sink.h"

namespace sgm::api {

Result<uint32_t> findParameter(const Program& program, std::string_view name) {
  if (const uint32_t index = program.findParam(name); index != kNoId) return index;
  Suggestion nearest(name);
  for (const Param& param : program.params) nearest.offer(program.text(param.name));
  std::string message = join({"the grammar has no parameter '", name, "'"});
  if (const std::string hint = nearest.hint(); !hint.empty()) message += "; " + hint;
  // The maximum number of parameter names that a message lists, because a grammar may have hundreds.
  constexpr size_t kMaxNames = 12;
  const size_t count = program.params.size();
  message += count == 0 ? "; it has none" : "; it has ";
  for (size_t i = 0; i < std::min(count, kMaxNames); ++i)
    message += join({i == 0 ? "" : ", ", program.text(program.params[i].name)});
  if (count > kMaxNames) message += join({" and ", std::to_string(count - kMaxNames), " more"});
  return Error{Code::invalid_argument, message};
}

Result<void> setFromText(const Program& program, std::string_view name, std::string_view text,
                         ParameterValues& values) {
  const Result<uint32_t> index = findParameter(program, name);
  if (!index) return index.error();

  constexpr uint32_t kMaxTokens = 8;
  DiagnosticSink sink(kMaxTokens);
  const LexResult lexed = lex(text, 0, kMaxTokens, sink, std::pmr::get_default_resource());
  if (const std::vector<Diagnostic> wrong = sink.take(); !wrong.empty())
    return Error{Code::bad_input, join({"parameter '", name, "': ", wrong.front().message})};
  size_t at = 0;
  const auto kind = [&](size_t i) { return i < lexed.tokens.size() ? lexed.tokens[i].kind : Tok::end; };
  const bool negative = kind(at) == Tok::minus;
  if (negative || kind(at) == Tok::plus) ++at;
  if (kind(at) != Tok::number || kind(at + 1) != Tok::end)
    return Error{Code::bad_input, join({"parameter '", name, "': '", text, "' is not a number with its unit"})};

  const Token& number = lexed.tokens[at];
  const Dim wanted = program.params[*index].dim;
  const double value = negative ? -number.value : number.value;
  if (wanted == kLength && number.dim == kRatio && value != 0 && program.unit != kNoId)
    return setFromText(program, name, join({text, program.text(program.unit)}), values);
  if (!(number.dim == wanted) && !(number.value == 0 && number.dim == kRatio))
    return Error{Code::bad_input, join({"parameter '", name, "' has the dimension ", dimName(wanted), ", but '", text,
                                        "' has the dimension ", dimName(number.dim)})};
  return values.set(program, name, value);
}

}  // namespace sgm::api
