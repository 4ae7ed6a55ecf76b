#pragma once
// Loads libcurl when a server is first read from: other programs do not need it.

#include <curl/curl.h>

#include "base/result.h"

namespace sgm::store {

/// libcurl's functions. They allocate from libcurl's own heap.
struct CurlTable {
  decltype(&::curl_global_init) global_init = nullptr;
  decltype(&::curl_easy_init) easy_init = nullptr;
  decltype(&::curl_easy_cleanup) easy_cleanup = nullptr;
  decltype(&::curl_easy_setopt) easy_setopt = nullptr;
  decltype(&::curl_easy_perform) easy_perform = nullptr;
  decltype(&::curl_easy_getinfo) easy_getinfo = nullptr;
  decltype(&::curl_easy_strerror) easy_strerror = nullptr;
};

/// unsupported: libcurl is missing or damaged. It stays loaded until the process ends.
Result<CurlTable> loadCurl();

}  // namespace sgm::store
