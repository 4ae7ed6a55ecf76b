#pragma once
// Loads libcurl at run time, when a server is first accessed. Programs that use no server do not need libcurl.

#include <curl/curl.h>

#include "base/result.h"

namespace sgm::store {

/// Pointers to functions of libcurl. They allocate from libcurl's own heap, not from a std::pmr::memory_resource.
struct CurlTable {
  decltype(&::curl_global_init) global_init = nullptr;
  decltype(&::curl_easy_init) easy_init = nullptr;
  decltype(&::curl_easy_cleanup) easy_cleanup = nullptr;
  decltype(&::curl_easy_setopt) easy_setopt = nullptr;
  decltype(&::curl_easy_perform) easy_perform = nullptr;
  decltype(&::curl_easy_getinfo) easy_getinfo = nullptr;
  decltype(&::curl_easy_strerror) easy_strerror = nullptr;
};

/// Loads libcurl. It stays loaded until the process ends. Error: unsupported if libcurl is missing or lacks a function.
Result<CurlTable> loadCurl();

}  // namespace sgm::store
