#pragma once
// Who may ask: pages of other sites may not, whatever name they give this machine, and strangers not without the token.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "tools/service/http/message.h"

namespace sgm::service {

struct AccessSettings {
  std::string address = "127.0.0.1";    ///< that is listened on
  std::string token;                    ///< empty: none is asked for
  std::vector<std::string> host_names;  ///< under which clients may know this server, beside its address
};

/// Whether an address in numbers is this machine's own loopback; false for a text that is no address.
bool isLoopback(std::string_view address);

class Access {
 public:
  /// Errors: invalid_argument for an address that is not in numbers, one beside loopback without a token, a token
  /// of fewer than 16 characters or with others than letters, digits and -._~+/=, and a name that is no host's.
  static Result<Access> create(const AccessSettings& settings);

  /// The answer to a request that may not be made: 421 for a Host that is no name of ours (a site that gives its own
  /// name our address is told nothing), 403 for an Origin beside ours. Nothing: it may.
  std::optional<http::Response> refuse(const http::Request& request) const;
  /// 401 where there is a token and the request does not have it.
  std::optional<http::Response> refuseStranger(const http::Request& request) const;

 private:
  bool isOurs(std::string_view host) const;

  std::string token_;
  std::vector<std::string> names_;  ///< in small letters, without ports
  bool any_address_ = false;        ///< all of the machine's addresses are listened on
};

}  // namespace sgm::service
