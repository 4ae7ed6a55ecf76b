#pragma once
// Loads libcurl when a server is first accessed: programs that use no server do not need it.

#include <curl/curl.h>

#include "base/result.h"

namespace sgm::store {

/// Pointers to libcurl's functions. These allocate from libcurl's own heap, not from the caller's memory resources.
struct CurlTable {
  decltype(&::curl_global_init) global_init = nullptr;
  decltype(&::curl_easy_init) easy_init = nullptr;
  decltype(&::curl_easy_cleanup) easy_cleanup = nullptr;
  decltype(&::curl_easy_setopt) easy_setopt = nullptr;
  decltype(&::curl_easy_perform) easy_perform = nullptr;
  decltype(&::curl_easy_getinfo) easy_getinfo = nullptr;
  decltype(&::curl_easy_strerror) easy_strerror = nullptr;
};

/// Loads libcurl, which stays loaded until the process ends. Error: unsupported if libcurl is missing or lacks a
/// function.
Result<CurlTable> loadCurl();

}  // namespace sgm::store
