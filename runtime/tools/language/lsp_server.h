#pragma once
// The language server: handles each incoming message and returns the outgoing messages. lsp.cpp reads and writes the
// messages.

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "grammar/help/declarations.h"
#include "tools/language/lsp_text.h"

namespace sgm::cli {

/// Implements the Language Server Protocol 3.17 for grammars: diagnostics, completion, hover, definition, symbols,
/// formatting. The text of an open document takes precedence over its file; imports are looked up in the folder of the
/// importing document. Not thread-safe.
class LanguageServer {
 public:
  using Json = nlohmann::json;

  /// Handles a message and returns the messages to send: an error for a request that cannot be processed, none for an
  /// unknown notification. May throw std::bad_alloc.
  std::vector<Json> handle(const Json& message);
  /// The response that the protocol requires for bytes that are not JSON.
  static Json answerToGarbage(const std::string& why);

  bool ended() const { return state_ == State::ended; }
  /// Whether the client sent the request `shutdown` before the notification `exit`, as the protocol requires.
  bool endedWell() const { return asked_to_end_; }

 private:
  enum class State { fresh, running, shutdown, ended };
  /// A document with its declarations: open in the editor, or read from a file.
  struct Source {
    std::string uri;
    DocumentText text;
    Declarations declarations;
  };
  /// A declared name to which a position in a document refers, and the document that declares it.
  struct Target {
    Source source;
    DeclaredName name;
  };

  /// An error response to a request: the protocol's error code, and the reason.
  struct Refusal {
    int code;
    std::string why;
  };
  using Answer = std::variant<Json, Refusal>;

  static Json errorAnswer(const Json& id, const Refusal& refusal);
  Answer answer(const std::string& method, const Json& params);
  void notify(const std::string& method, const Json& params, std::vector<Json>& out);
  void diagnose(const std::string& uri, std::vector<Json>& out);
  void diagnoseAll(std::vector<Json>& out);
  void publish(const std::string& uri, const Json& diagnostics, std::vector<Json>& out) const;

  Answer completion(const Json& params) const;
  Answer hover(const Json& params) const;
  Answer definition(const Json& params) const;
  Answer symbols(const Json& params) const;
  Answer format(const Json& params) const;
  Answer standardText(const Json& params) const;

  std::vector<Target> targetsAt(const std::string& uri, uint32_t offset) const;
  std::optional<Source> imported(const std::string& from_uri, const std::string& path) const;
  std::optional<std::string> textOf(const std::string& uri) const;
  /// The open document that the parameters of a request name; null if it is not open.
  const DocumentText* document(const Json& params) const;

  State state_ = State::fresh;
  bool asked_to_end_ = false;
  std::map<std::string, DocumentText> documents_;  ///< by URI
  /// For each open document, the URIs of the files for which diagnostics were published.
  std::map<std::string, std::set<std::string>> diagnosed_;
};

}  // namespace sgm::cli
