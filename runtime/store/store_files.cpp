#include "store/store_files.h"

#include <algorithm>

#include "store/folder.h"
#include "store/http_files.h"

namespace sgm::store {

bool isAddress(const std::string& place) {
  const size_t colon = place.find("://");
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return colon != std::string::npos && colon > 0 &&
         std::all_of(place.begin(), place.begin() + static_cast<ptrdiff_t>(colon), is_letter);
}

std::string shownPlace(const std::string& place) {
  if (!isAddress(place)) return place;
  const size_t host = place.find("://") + 3, path = std::min(place.find('/', host), place.size());
  const std::string authority = place.substr(host, path - host);
  size_t at = authority.rfind('@');
  if (at == std::string::npos) {
    // A password in a URL should have '/' written as %2F, but may contain the character itself. Then `authority` ends
    // within the password, and the text after its last ':' is not a port number.
    const size_t colon = authority.rfind(':');
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    if (colon == std::string::npos || authority.back() == ']' ||
        std::all_of(authority.begin() + static_cast<ptrdiff_t>(colon) + 1, authority.end(), is_digit))
      return place;
    at = place.rfind('@');
    if (at == std::string::npos || at < host) return place;
    at -= host;
  }
  return place.substr(0, host) + place.substr(host + at + 1);
}

Result<void> checkHere(const std::string& place) {
  if (!isAddress(place)) return {};
  return Error{Code::invalid_argument,
               "'" + shownPlace(place) + "' is on a server: pass a folder, because only streaming reads from servers"};
}

Result<std::unique_ptr<StoreFiles>> storeFiles(const std::string& place, const Log& log,
                                               std::pmr::memory_resource* memory) {
  if (isAddress(place)) return httpFiles(place, log, memory);
  return folderFiles(place);
}

}  // namespace sgm::store
