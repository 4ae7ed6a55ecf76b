#pragma once
// libcurl, looked for when a server is first to be read from: a program that reads from none does without it.

#include <curl/curl.h>

#include "base/result.h"

namespace sgm::store {

/// Its functions. What they allocate comes from its own heap.
struct CurlTable {
  decltype(&::curl_global_init) global_init = nullptr;
  decltype(&::curl_easy_init) easy_init = nullptr;
  decltype(&::curl_easy_cleanup) easy_cleanup = nullptr;
  decltype(&::curl_easy_setopt) easy_setopt = nullptr;
  decltype(&::curl_easy_perform) easy_perform = nullptr;
  decltype(&::curl_easy_getinfo) easy_getinfo = nullptr;
  decltype(&::curl_easy_strerror) easy_strerror = nullptr;
};

/// unsupported: it is not there, or is damaged. It stays loaded for as long as the process runs.
Result<CurlTable> loadCurl();

}  // namespace sgm::store
