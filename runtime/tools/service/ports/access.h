#pragma once
// Access control: rejects pages of other sites, under any name of this machine, and clients without the token.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "tools/service/http/message.h"

namespace sgm::service {

struct AccessSettings {
  std::string address = "127.0.0.1";    ///< the listening address
  std::string token;                    ///< empty: no token is required
  std::vector<std::string> host_names;  ///< further names of this server, besides its address
};

/// Whether a numeric address is this machine's loopback; false for any other text.
bool isLoopback(std::string_view address);

class Access {
 public:
  /// Error: invalid_argument for an address that is not numeric, an address other than loopback without a token, a
  /// token of fewer than 16 characters or with characters other than letters, digits and -._~+/=, or an invalid host
  /// name.
  static Result<Access> create(const AccessSettings& settings);

  /// The answer to a forbidden request: 421 for an unknown Host (a site that resolves its own name to our address gets
  /// no data), 403 for an Origin other than ours. nullopt if it is allowed.
  std::optional<http::Response> refuse(const http::Request& request) const;
  /// 401 if there is a token and the request does not have it.
  std::optional<http::Response> refuseStranger(const http::Request& request) const;

 private:
  bool isOurs(std::string_view host) const;

  std::string token_;
  std::vector<std::string> names_;  ///< in lower case, without ports
  bool any_address_ = false;        ///< the server listens on all addresses of the machine
};

}  // namespace sgm::service
