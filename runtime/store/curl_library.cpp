#include "store/curl_library.h"

#include "base/platform/library.h"

namespace sgm::store {

Result<CurlTable> loadCurl() {
  void* library = platform::openLibrary("libcurl.so.4");
  // Debian also packages libcurl built with other TLS libraries, under these names. They have the same functions.
  for (const char* name : {"libcurl-gnutls.so.4", "libcurl-nss.so.4"}) {
    if (library == nullptr) library = platform::openLibrary(name);
  }
  if (library == nullptr)
    return Error{Code::unsupported, "reading stores from servers needs libcurl: install the package libcurl4"};
  CurlTable table;
  bool complete = true;
  const auto load = [&]<class F>(F& function, const char* name) {
    function = reinterpret_cast<F>(platform::symbolOf(library, name));
    complete = complete && function != nullptr;
  };
  load(table.global_init, "curl_global_init");
  load(table.easy_init, "curl_easy_init");
  load(table.easy_cleanup, "curl_easy_cleanup");
  load(table.easy_setopt, "curl_easy_setopt");
  load(table.easy_perform, "curl_easy_perform");
  load(table.easy_getinfo, "curl_easy_getinfo");
  load(table.easy_strerror, "curl_easy_strerror");
  if (!complete) return Error{Code::unsupported, "libcurl.so.4 is damaged: reinstall the package libcurl4"};
  return table;
}

}  // namespace sgm::store
