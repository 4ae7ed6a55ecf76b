#include "tools/service/ports/access.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>

#include "tools/service/ports/field_values.h"

namespace sgm::service {
namespace {

using http::Problem;
using http::Request;
using http::Response;

constexpr size_t kShortestToken = 16;

bool isLetterOrDigit(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

enum class Numbers { none, four, six };

/// Whether a text is a numeric IPv4 or IPv6 address. Sets `bytes` to the address if it is one.
Numbers numbersOf(std::string_view text, std::array<unsigned char, 16>& bytes) {
  const std::string ended(text);
  if (inet_pton(AF_INET, ended.c_str(), bytes.data()) == 1) return Numbers::four;
  return inet_pton(AF_INET6, ended.c_str(), bytes.data()) == 1 ? Numbers::six : Numbers::none;
}

bool isAnyAddress(std::string_view address) {
  std::array<unsigned char, 16> bytes{};
  return numbersOf(address, bytes) != Numbers::none &&
         std::all_of(bytes.begin(), bytes.end(), [](unsigned char b) { return b == 0; });
}

bool isHostName(std::string_view name) {
  return !name.empty() && name.size() <= 253 &&
         std::all_of(name.begin(), name.end(), [](char c) { return isLetterOrDigit(c) || c == '-' || c == '.'; });
}

/// The host name in the value of a Host header, without port and brackets. Empty if the name is followed by something
/// other than a port.
std::string_view nameOf(std::string_view host) {
  std::string_view name, rest;
  if (host.starts_with('[')) {
    const size_t end = host.find(']');
    if (end == host.npos) return {};
    name = host.substr(1, end - 1);
    rest = host.substr(end + 1);
  } else {
    name = host.substr(0, host.find(':'));
    rest = host.substr(name.size());
  }
  const bool port =
      rest.starts_with(':') && std::all_of(rest.begin() + 1, rest.end(), [](char c) { return c >= '0' && c <= '9'; });
  return rest.empty() || port ? name : std::string_view{};
}

/// Compares two secrets. The time does not depend on where they differ, so a client cannot find out a secret by
/// measuring times.
bool equalInSecret(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^
                                        static_cast<unsigned char>(b.empty() ? 0 : b[i % b.size()]));
  return difference == 0;
}

}  // namespace

bool isLoopback(std::string_view address) {
  std::array<unsigned char, 16> bytes{};
  switch (numbersOf(address, bytes)) {
    case Numbers::four:
      return bytes[0] == 127;
    case Numbers::six: {
      std::array<unsigned char, 16> one{};
      one[15] = 1;
      return bytes == one;
    }
    case Numbers::none:
      break;
  }
  return false;
}

Result<Access> Access::create(const AccessSettings& settings) {
  const auto wrong = [](std::string message) { return Error{Code::invalid_argument, std::move(message)}; };
  std::array<unsigned char, 16> bytes{};
  if (numbersOf(settings.address, bytes) == Numbers::none)
    return wrong("'" + settings.address +
                 "' is not an address to listen on: use a numeric one such as 127.0.0.1 or ::1");
  if (settings.token.empty() && !isLoopback(settings.address))
    return wrong("to listen on " + settings.address + " a token is required, since other machines can reach it");
  const auto fits = [](char c) {
    return isLetterOrDigit(c) || std::string_view("-._~+/=").find(c) != std::string::npos;
  };
  if (!settings.token.empty() &&
      (settings.token.size() < kShortestToken || !std::all_of(settings.token.begin(), settings.token.end(), fits)))
    return wrong("the token must have at least 16 characters, which are letters, digits and -._~+/=");
  Access access;
  access.token_ = settings.token;
  access.any_address_ = isAnyAddress(settings.address);
  access.names_ = {"localhost", "127.0.0.1", "::1", inSmallLetters(settings.address)};
  for (const std::string& name : settings.host_names) {
    if (!isHostName(name)) return wrong("'" + name + "' is not a host name");
    access.names_.push_back(inSmallLetters(name));
  }
  return access;
}

bool Access::isOurs(std::string_view host) const {
  const std::string_view name = nameOf(host);
  std::array<unsigned char, 16> bytes{};
  // Accept any numeric address in the Host header: DNS rebinding, in which a foreign site's host name resolves to this
  // machine, sends a name and not a number.
  if (any_address_ && numbersOf(name, bytes) != Numbers::none) return true;
  return std::find(names_.begin(), names_.end(), inSmallLetters(name)) != names_.end();
}

std::optional<Response> Access::refuse(const Request& request) const {
  const std::string_view host = request.field("Host").value_or("");
  if (!isOurs(host)) {
    return makeResponse(
        Problem{421, "misdirected",
                "this server does not answer to the name in Host; add the name with --host if it should", ""});
  }
  const std::optional<std::string_view> origin = request.field("Origin");
  if (!origin) return std::nullopt;
  const std::string ours = inSmallLetters(host), theirs = inSmallLetters(*origin);
  if (theirs == "http://" + ours || theirs == "https://" + ours) return std::nullopt;
  return makeResponse(Problem{403, "foreign_origin", "pages of other sites may not use this server", ""});
}

std::optional<Response> Access::refuseStranger(const Request& request) const {
  if (token_.empty()) return std::nullopt;
  const std::string_view given = request.field("Authorization").value_or("");
  constexpr std::string_view kScheme = "bearer ";
  if (given.size() > kScheme.size() && inSmallLetters(given.substr(0, kScheme.size())) == kScheme &&
      equalInSecret(given.substr(kScheme.size()), token_))
    return std::nullopt;
  Response response = makeResponse(
      Problem{401, "no_token", "this request needs the token of the server, as Authorization: Bearer TOKEN", ""});
  response.fields.push_back({"WWW-Authenticate", "Bearer"});
  return response;
}

}  // namespace sgm::service
