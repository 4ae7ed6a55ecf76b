#pragma once
// Reads complete files, or only their first bytes.

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/result.h"

namespace sgm {

enum class Readable {
  regular_files,
  all_but_folders,  ///< also pipes and devices; reading blocks until they deliver bytes or end
};

/// Reads a whole file. Errors: io, with the path and the system's reason; limit if the file has more than `max_bytes`
/// bytes. Throws std::bad_alloc.
Result<std::string> readFile(const std::filesystem::path& path, uint64_t max_bytes,
                             Readable readable = Readable::regular_files);

/// Reads the first `bytes` of a regular file, or all of it if it is smaller. Error: io.
Result<std::string> readBeginning(const std::filesystem::path& path, size_t bytes);

/// Reads an open file descriptor (platform/file.h) from its current position to its end. name: for error messages.
/// Errors: as readFile().
Result<std::string> readOpenFile(int file, const std::string& name, uint64_t max_bytes);

}  // namespace sgm
