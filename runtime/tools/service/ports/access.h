#pragma once
// Access control: rejects requests that pages of other sites make, under any name of this machine, and clients without
// the token.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "tools/service/http/message.h"

namespace sgm::service {

struct AccessSettings {
  std::string address = "127.0.0.1";    ///< the address on which the server listens
  std::string token;                    ///< token that clients must send; empty: no token is required
  std::vector<std::string> host_names;  ///< names of this server that clients may use in addition to its address
};

/// Whether the text is a numeric loopback address of this machine.
bool isLoopback(std::string_view address);

class Access {
 public:
  /// Error: invalid_argument for an address that is not numeric, an address other than loopback without a token, a
  /// token of fewer than 16 characters or with characters other than letters, digits and -._~+/=, or an invalid host
  /// name.
  static Result<Access> create(const AccessSettings& settings);

  /// The answer to a forbidden request: 421 for an unknown Host (so that a site that resolves its own name to our
  /// address gets no data), 403 for an Origin other than ours. nullopt if the request is allowed.
  std::optional<http::Response> refuse(const http::Request& request) const;
  /// The answer 401 if a token is required and the request does not have it; nullopt otherwise.
  std::optional<http::Response> refuseStranger(const http::Request& request) const;

 private:
  bool isOurs(std::string_view host) const;

  std::string token_;
  std::vector<std::string> names_;  ///< accepted host names in lower case, without ports
  bool any_address_ = false;        ///< the server listens on all addresses of the machine
};

}  // namespace sgm::service
