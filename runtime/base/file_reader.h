#pragma once
// Reads complete files, or only their first bytes.

#include <cstdint>
#include <filesystem>
#include <string>

#include "base/result.h"

namespace sgm {

enum class Readable {
  regular_files,
  all_but_folders,  ///< pipes and devices in addition to regular files; reading these blocks until data arrive
};

/// Reads a whole file. Errors: io, with the path and the system's reason; limit if the file has more than `max_bytes`
/// bytes. Throws std::bad_alloc.
Result<std::string> readFile(const std::filesystem::path& path, uint64_t max_bytes,
                             Readable readable = Readable::regular_files);

/// Reads the first `bytes` bytes of a regular file, or the whole file if it is smaller. Error: io.
Result<std::string> readBeginning(const std::filesystem::path& path, size_t bytes);

/// Reads an open file descriptor (platform/file.h) from its current position to its end. name: used in error messages
/// only. Errors: those of readFile().
Result<std::string> readOpenFile(int file, const std::string& name, uint64_t max_bytes);

}  // namespace sgm
