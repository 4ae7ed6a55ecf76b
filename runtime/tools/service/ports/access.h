#pragma once
// Access control: rejects requests from web pages of other sites, whatever name they use for this machine, and from
// clients without the token.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "tools/service/http/message.h"

namespace sgm::service {

struct AccessSettings {
  std::string address = "127.0.0.1";    ///< numeric address on which the server listens
  std::string token;                    ///< token that clients must send; if empty, no token is required
  std::vector<std::string> host_names;  ///< host names of this server that clients may use in addition to its address
};

/// Whether the text is a numeric loopback address, such as 127.0.0.1.
bool isLoopback(std::string_view address);

class Access {
 public:
  /// Error: invalid_argument if the address is not numeric, if there is no token and the address is not loopback, if
  /// the token has fewer than 16 characters or contains other characters than letters, digits and -._~+/=, or if a host
  /// name is invalid.
  static Result<Access> create(const AccessSettings& settings);

  /// The answer to a forbidden request; nullopt if the request is allowed. 421 for an unknown Host, to prevent DNS
  /// rebinding, in which a foreign host name resolves to this machine; 403 for the Origin of another site.
  std::optional<http::Response> refuse(const http::Request& request) const;
  /// A 401 if a token is required and the request does not have it; otherwise nullopt.
  std::optional<http::Response> refuseStranger(const http::Request& request) const;

 private:
  bool isOurs(std::string_view host) const;

  std::string token_;
  std::vector<std::string> names_;  ///< accepted host names, in lower case and without ports
  bool any_address_ = false;        ///< whether the server listens on all addresses of this machine
};

}  // namespace sgm::service
