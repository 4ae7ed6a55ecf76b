#include "tools/language/lsp_server.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "api/import.h"
#include "base/file_reader.h"
#include "grammar/check_file.h"
#include "grammar/help/word_help.h"
#include "grammar/parse/imports.h"
#include "grammar/std/std_library.h"
#include "grammar/syntax/builtins.h"
#include "grammar/syntax/keywords.h"
#include "sgm/sgm.h"

namespace sgm::cli {
namespace {

using Json = nlohmann::json;

// Error codes of JSON-RPC and of the Language Server Protocol.
constexpr int kParseError = -32700, kInvalidRequest = -32600, kMethodNotFound = -32601, kInvalidParams = -32602,
              kServerNotInitialized = -32002;
constexpr const char* kNotOpen = "this document is not open: send textDocument/didOpen first";
constexpr int kErrorSeverity = 1, kWarningSeverity = 2;

/// URI scheme of the standard library's modules. Editors request the text of such a module with the request
/// sgm/standardText.
constexpr std::string_view kStandardUri = "sgm-std:/";

Json toJson(const TextPosition& p) { return {{"line", p.line}, {"character", p.character}}; }

Json rangeJson(const DocumentText& text, TextRange range) {
  return {{"start", toJson(text.position(range.begin))}, {"end", toJson(text.position(range.end))}};
}

uint32_t offsetAt(const DocumentText& text, const Json& params) {
  const Json& position = params.at("position");
  return text.offset({position.at("line").get<uint32_t>(), position.at("character").get<uint32_t>()});
}

/// Applies a text change that the client has sent. The server asks for whole texts, but a client may also send a
/// replacement for a range of the text.
DocumentText changed(const DocumentText& before, const Json& change) {
  std::string text = change.at("text").get<std::string>();
  if (!change.contains("range") || change.at("range").is_null()) return DocumentText(std::move(text));
  const auto place = [&](const char* end) {
    const Json& at = change.at("range").at(end);
    return before.offset({at.at("line").get<uint32_t>(), at.at("character").get<uint32_t>()});
  };
  const auto [begin, end] = std::minmax({place("start"), place("end")});
  return DocumentText(before.text().substr(0, begin) + text + before.text().substr(end));
}

std::string folderOf(const std::string& uri) {
  return std::filesystem::path(pathOfUri(uri)).parent_path().lexically_normal().string();
}

/// Resolves an import to the open document with that path if there is one, otherwise to a file.
class OpenImports : public ImportResolver {
 public:
  OpenImports(const std::map<std::string, DocumentText>& open, std::string folder)
      : open_(open), folder_(folder.empty() ? "." : std::move(folder)), files_(folder_) {}

  Result<std::string> read(std::string_view path, size_t limit) override {
    const auto document = open_.find(uriOfPath((folder_ / path).lexically_normal().string()));
    if (document == open_.end()) return files_.read(path, limit);
    if (document->second.text().size() > limit) return Error{Code::limit, "the document is too large"};
    return document->second.text();
  }

 private:
  const std::map<std::string, DocumentText>& open_;
  std::filesystem::path folder_;
  api::FolderImports files_;
};

/// The protocol's numbers for a kind of declared name: the kind of completion item, and the kind of symbol.
struct KindNumbers {
  int completion, symbol;
};

KindNumbers numbersOf(NameKind kind) {
  switch (kind) {
    case NameKind::import:
      return {9, 2};  // module
    case NameKind::parameter:
      return {10, 7};  // property
    case NameKind::let:
    case NameKind::field:
      return {3, 12};  // function
    case NameKind::rule:
    case NameKind::morphic:
      return {7, 5};  // class
    case NameKind::layer:
      return {22, 23};  // struct
    case NameKind::local:
      return {6, 13};  // variable
  }
  return {6, 13};
}

Json wordItem(std::string_view word, int kind) {
  Json item{{"label", word}, {"kind", kind}};
  if (const std::string forms = callForms(word); !forms.empty()) item["detail"] = forms;
  if (const std::string_view help = wordHelp(word); !help.empty()) item["documentation"] = help;
  return item;
}

Json nameItem(const DeclaredName& name) {
  Json item{{"label", name.name}, {"kind", numbersOf(name.kind).completion}, {"detail", name.head}};
  if (!name.doc.empty()) item["documentation"] = name.doc;
  return item;
}

std::string hoverText(const DeclaredName& name) {
  std::string text = "```sgm\n" + name.head + "\n```";
  if (!name.doc.empty()) text += "\n\n" + name.doc;
  return text;
}

/// The exception's message without the JSON library's name and error number.
std::string reasonOf(const Json::exception& error) {
  const std::string_view text = error.what();
  const size_t end = text.starts_with('[') ? text.find("] ") : std::string_view::npos;
  return std::string(end == std::string_view::npos ? text : text.substr(end + 2));
}

}  // namespace

Json LanguageServer::errorAnswer(const Json& id, const Refusal& refusal) {
  return {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", refusal.code}, {"message", refusal.why}}}};
}

Json LanguageServer::answerToGarbage(const std::string& why) { return errorAnswer(nullptr, {kParseError, why}); }

std::vector<Json> LanguageServer::handle(const Json& message) {
  std::vector<Json> out;
  const bool object = message.is_object();
  const Json id = object && message.contains("id") ? message.at("id") : Json();
  const bool request = object && message.contains("id");
  // A message with a result or an error is a response. This server sends no requests, so it ignores responses.
  if (object && !message.contains("method") && (message.contains("result") || message.contains("error"))) return out;
  if (!object || !message.contains("method") || !message.at("method").is_string() ||
      (request && !id.is_string() && !id.is_number_integer())) {
    out.push_back(errorAnswer(
        nullptr, {kInvalidRequest, "a message must be an object with a method, and its id a string or an integer"}));
    return out;
  }
  const std::string method = message.at("method");
  const Json params = message.contains("params") ? message.at("params") : Json::object();
  // If params do not follow the protocol, the JSON library throws an exception; the handler below converts it to an
  // error answer.
  try {
    if (!request) {
      notify(method, params, out);
      return out;
    }
    const Answer answered = answer(method, params);
    if (const Refusal* refusal = std::get_if<Refusal>(&answered))
      out.push_back(errorAnswer(id, *refusal));
    else
      out.push_back({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::get<Json>(answered)}});
  } catch (const Json::exception& e) {
    if (request) out.push_back(errorAnswer(id, {kInvalidParams, "params: " + reasonOf(e)}));
  }
  return out;
}

LanguageServer::Answer LanguageServer::answer(const std::string& method, const Json& params) {
  if (method == "initialize") {
    if (state_ != State::fresh) return Refusal{kInvalidRequest, "initialize must be sent once, as the first request"};
    state_ = State::running;
    const Json told = {{"capabilities",
                        {{"positionEncoding", "utf-16"},
                         {"textDocumentSync", {{"openClose", true}, {"change", 1}}},
                         {"completionProvider", {{"triggerCharacters", {"."}}}},
                         {"hoverProvider", true},
                         {"definitionProvider", true},
                         {"documentSymbolProvider", true},
                         {"documentFormattingProvider", true}}},
                       {"serverInfo", {{"name", "sgm"}, {"version", sgm_version_string()}}}};
    return told;
  }
  if (state_ == State::fresh) return Refusal{kServerNotInitialized, "the first request must be initialize"};
  if (state_ != State::running) return Refusal{kInvalidRequest, "the server was shut down"};
  if (method == "shutdown") {
    state_ = State::shutdown;
    asked_to_end_ = true;
    return Json();
  }
  if (method == "textDocument/completion") return completion(params);
  if (method == "textDocument/hover") return hover(params);
  if (method == "textDocument/definition") return definition(params);
  if (method == "textDocument/documentSymbol") return symbols(params);
  if (method == "textDocument/formatting") return format(params);
  if (method == "sgm/standardText") return standardText(params);
  return Refusal{kMethodNotFound, "unknown method " + method};
}

void LanguageServer::notify(const std::string& method, const Json& params, std::vector<Json>& out) {
  if (method == "exit") {
    state_ = State::ended;
    return;
  }
  if (state_ != State::running) return;
  if (method == "textDocument/didOpen") {
    const Json& document = params.at("textDocument");
    const std::string uri = document.at("uri");
    documents_[uri] = DocumentText(document.at("text").get<std::string>());
    diagnoseAll(out);
  } else if (method == "textDocument/didChange") {
    const std::string uri = params.at("textDocument").at("uri");
    const Json& changes = params.at("contentChanges");
    if (!documents_.contains(uri) || changes.empty()) return;
    // Apply either all changes or none: an invalid change throws before the document is replaced.
    DocumentText text = documents_[uri];
    for (const Json& change : changes) text = changed(text, change);
    documents_[uri] = std::move(text);
    diagnoseAll(out);
  } else if (method == "textDocument/didClose") {
    const std::string uri = params.at("textDocument").at("uri");
    if (documents_.erase(uri) == 0) return;
    for (const std::string& about : diagnosed_[uri]) publish(about, Json::array(), out);
    diagnosed_.erase(uri);
    diagnoseAll(out);
  }
}

/// Publishes diagnostics of all open documents: a changed document may also add or remove errors in documents that
/// import it.
void LanguageServer::diagnoseAll(std::vector<Json>& out) {
  for (const auto& [open, text] : documents_) diagnose(open, out);
}

void LanguageServer::publish(const std::string& uri, const Json& diagnostics, std::vector<Json>& out) const {
  out.push_back({{"jsonrpc", "2.0"},
                 {"method", "textDocument/publishDiagnostics"},
                 {"params", {{"uri", uri}, {"diagnostics", diagnostics}}}});
}

void LanguageServer::diagnose(const std::string& uri, std::vector<Json>& out) {
  const std::string folder = folderOf(uri);
  OpenImports imports(documents_, folder);
  CompileOptions options;
  options.resolver = &imports;
  const CompileResult compiled = checkFile(documents_[uri].text(), uri, options).compiled;
  std::map<std::string, Json> of_file{{uri, Json::array()}};
  for (const Diagnostic& d : compiled.diagnostics) {
    const bool own = d.file == uri;
    const std::string about =
        own ? uri : uriOfPath((std::filesystem::path(folder) / d.file).lexically_normal().string());
    DocumentText text = own ? documents_[uri] : DocumentText();
    for (const SourceFile& file : compiled.files)
      if (!own && file.path == d.file) text = DocumentText(file.text);
    const TextRange range{text.offsetOf(d.line, d.column), text.offsetOf(d.line, d.end_column)};
    std::string message = d.message;
    if (!d.hint.empty()) message += "\n" + d.hint;
    for (const std::string& note : d.notes) message += "\n" + note;
    of_file[about].push_back({{"range", rangeJson(text, range)},
                              {"severity", d.severity == Severity::error ? kErrorSeverity : kWarningSeverity},
                              {"code", d.code},
                              {"source", "sgm"},
                              {"message", std::move(message)}});
  }
  std::set<std::string>& before = diagnosed_[uri];
  for (const std::string& about : before)
    if (!of_file.contains(about) && !documents_.contains(about)) publish(about, Json::array(), out);
  before.clear();
  for (const auto& [about, diagnostics] : of_file) {
    // Skip errors in another open document: they are published with the diagnostics of that document.
    if (about != uri && documents_.contains(about)) continue;
    publish(about, diagnostics, out);
    before.insert(about);
  }
}

const DocumentText* LanguageServer::document(const Json& params) const {
  const std::string uri = params.at("textDocument").at("uri");
  const auto found = documents_.find(uri);
  return found == documents_.end() ? nullptr : &found->second;
}

std::optional<std::string> LanguageServer::textOf(const std::string& uri) const {
  if (uri.starts_with(kStandardUri)) {
    const std::string_view text = standardModule("std/" + uri.substr(kStandardUri.size()));
    return text.empty() ? std::nullopt : std::optional(std::string(text));
  }
  if (const auto open = documents_.find(uri); open != documents_.end()) return open->second.text();
  Result<std::string> text = readFile(pathOfUri(uri), CompileLimits{}.text_bytes);
  return text ? std::optional(std::move(*text)) : std::nullopt;
}

std::optional<LanguageServer::Source> LanguageServer::imported(const std::string& from_uri,
                                                               const std::string& path) const {
  if (!importPathProblem(path).empty() || isAssetPath(path)) return std::nullopt;
  std::string uri;
  if (from_uri.starts_with(kStandardUri))
    uri = std::string(kStandardUri) + path;
  else if (path.starts_with("std/"))
    uri = std::string(kStandardUri) + path.substr(4);
  else
    uri = uriOfPath((std::filesystem::path(folderOf(from_uri)) / path).lexically_normal().string());
  std::optional<std::string> text = textOf(uri);
  if (!text) return std::nullopt;
  Declarations declarations = declarationsOf(*text);
  return Source{uri, DocumentText(std::move(*text)), std::move(declarations)};
}

std::vector<LanguageServer::Target> LanguageServer::targetsAt(const std::string& uri, uint32_t offset) const {
  const std::optional<std::string> text = textOf(uri);
  if (!text) return {};
  const std::optional<WordAt> word = wordAt(*text, offset);
  if (!word || word->word.empty()) return {};
  const Declarations declarations = declarationsOf(*text);
  std::vector<Target> targets;
  if (!word->behind_dot) {
    for (const DeclaredName* name : declarations.find(word->word, offset))
      targets.push_back({{uri, DocumentText(*text), {}}, *name});
    return targets;
  }
  for (const DeclaredName* name : declarations.find(word->qualifier, offset)) {
    if (name->kind != NameKind::import) continue;
    const std::optional<Source> module = imported(uri, name->path);
    if (!module) continue;
    for (const DeclaredName& theirs : module->declarations.names)
      if (theirs.name == word->word && theirs.kind != NameKind::local) targets.push_back({*module, theirs});
  }
  return targets;
}

LanguageServer::Answer LanguageServer::completion(const Json& params) const {
  const DocumentText* open = document(params);
  if (open == nullptr) return Refusal{kInvalidParams, kNotOpen};
  const DocumentText& text = *open;
  const std::string uri = params.at("textDocument").at("uri");
  const uint32_t offset = offsetAt(text, params);
  const std::optional<WordAt> word = wordAt(text.text(), offset);
  Json items = Json::array();
  if (!word) return items;
  const Declarations declarations = declarationsOf(text.text());
  if (word->behind_dot) {
    for (const DeclaredName* name : declarations.find(word->qualifier, offset)) {
      if (name->kind != NameKind::import) continue;
      std::set<std::string> known;
      if (const std::optional<Source> module = imported(uri, name->path))
        for (const DeclaredName& theirs : module->declarations.names)
          if (theirs.kind != NameKind::local && theirs.kind != NameKind::import && known.insert(theirs.name).second)
            items.push_back(nameItem(theirs));
      return items;
    }
    const bool cell = word->qualifier == "cell";
    for (const char* member : {"x", "y", "z"})
      if (!cell) items.push_back({{"label", member}, {"kind", 5}});
    for (const char* member : {"point", "links", "faces", "center"})
      if (cell) items.push_back(wordItem(member, 2));
    if (!cell)
      for (const char* member : {"from", "to", "along", "depth", "other", "axis", "center", "point"})
        items.push_back({{"label", member}, {"kind", 5}});
    return items;
  }
  std::set<std::string> known;
  for (const DeclaredName& name : declarations.names)
    if (name.known.holds(offset) && known.insert(name.name).second) items.push_back(nameItem(name));
  for (const PrimitiveInfo& primitive : primitiveTable())
    if (known.emplace(primitive.name).second) items.push_back(wordItem(primitive.name, 7));
  for (const BuiltinInfo& builtin : builtinTable())
    if (known.emplace(builtin.name).second) items.push_back(wordItem(builtin.name, 3));
  for (const auto table : {keywordTable(), clauseWordTable()})
    for (const std::string_view keyword : table)
      if (known.emplace(keyword).second) items.push_back(wordItem(keyword, 14));
  for (const char* value : {"cell", "scope", "p", "q", "u"})
    if (known.emplace(value).second) items.push_back(wordItem(value, 21));
  return items;
}

LanguageServer::Answer LanguageServer::hover(const Json& params) const {
  const DocumentText* open = document(params);
  if (open == nullptr) return Refusal{kInvalidParams, kNotOpen};
  const DocumentText& text = *open;
  const uint32_t offset = offsetAt(text, params);
  const std::optional<WordAt> word = wordAt(text.text(), offset);
  if (!word || word->word.empty()) return Json();
  std::string value;
  for (const Target& target : targetsAt(params.at("textDocument").at("uri"), offset)) {
    if (!value.empty()) value += "\n\n";
    value += hoverText(target.name);
  }
  if (value.empty()) {
    if (const std::string forms = callForms(word->word); !forms.empty()) value = "```sgm\n" + forms + "\n```\n\n";
    value += wordHelp(word->word);
  }
  if (value.empty()) return Json();
  const Json told = {{"contents", {{"kind", "markdown"}, {"value", value}}}, {"range", rangeJson(text, word->at)}};
  return told;
}

LanguageServer::Answer LanguageServer::definition(const Json& params) const {
  const DocumentText* open = document(params);
  if (open == nullptr) return Refusal{kInvalidParams, kNotOpen};
  const DocumentText& text = *open;
  Json places = Json::array();
  for (const Target& target : targetsAt(params.at("textDocument").at("uri"), offsetAt(text, params)))
    places.push_back({{"uri", target.source.uri}, {"range", rangeJson(target.source.text, target.name.at)}});
  return places;
}

LanguageServer::Answer LanguageServer::symbols(const Json& params) const {
  const DocumentText* open = document(params);
  if (open == nullptr) return Refusal{kInvalidParams, kNotOpen};
  const DocumentText& text = *open;
  Json all = Json::array();
  for (const DeclaredName& name : declarationsOf(text.text()).names) {
    if (name.kind == NameKind::local) continue;
    all.push_back({{"name", name.name},
                   {"detail", nameKindText(name.kind)},
                   {"kind", numbersOf(name.kind).symbol},
                   {"range", rangeJson(text, name.whole)},
                   {"selectionRange", rangeJson(text, name.at)}});
  }
  return all;
}

LanguageServer::Answer LanguageServer::format(const Json& params) const {
  const DocumentText* open = document(params);
  if (open == nullptr) return Refusal{kInvalidParams, kNotOpen};
  const DocumentText& text = *open;
  const FormatResult formatted = formatGrammar(text.text(), "");
  if (!formatted.text || *formatted.text == text.text()) return Json::array();
  const TextRange all{0, static_cast<uint32_t>(text.text().size())};
  return Json::array({{{"range", rangeJson(text, all)}, {"newText", *formatted.text}}});
}

LanguageServer::Answer LanguageServer::standardText(const Json& params) const {
  const std::string uri = params.at("uri");
  const std::optional<std::string> text = uri.starts_with(kStandardUri) ? textOf(uri) : std::nullopt;
  if (!text) return Refusal{kInvalidParams, "the standard library has no part " + uri};
  return *text;
}

}  // namespace sgm::cli
