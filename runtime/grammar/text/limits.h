#pragma once
// The inputs and the limits of a compilation: grammar text is untrusted.

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <string>
#include <string_view>

#include "base/result.h"

namespace sgm {

/// Returns the text of an import, or the bytes of an asset. Paths are already checked: relative to the root file's
/// folder, forward slashes, no empty part, no "." or "..", no drive, not absolute, ending in ".sgm" or ".glb", at most
/// 255 bytes. A resolver that reads a disk must also refuse links that leave the folder. Called only on the compiling
/// thread.
class ImportResolver {
 public:
  virtual ~ImportResolver() = default;
  /// Error io if there is no such file; limit if it is longer than `limit` bytes.
  virtual Result<std::string> read(std::string_view path, size_t limit) = 0;
};

struct CompileLimits {
  size_t text_bytes = 1u << 20;          ///< of one file
  size_t total_bytes = 4u << 20;         ///< of all files
  size_t asset_bytes = 16u << 20;        ///< of one asset
  size_t total_asset_bytes = 64u << 20;  ///< of all assets
  uint32_t files = 64;                   ///< the same limit applies to assets
  uint32_t import_depth = 16;
  uint32_t nesting = 64;            ///< of blocks and of expressions
  uint32_t nodes = 1u << 20;        ///< tokens, expressions and statements together
  uint32_t diagnostics = 50;        ///< errors after which the compiler gives up
  uint32_t bound_steps = 1u << 18;  ///< for the analyses that evaluate rules
  int32_t neighbours = 4;           ///< cells that a layer's reach may cover to each side
};

struct CompileOptions {
  ImportResolver* resolver = nullptr;  ///< nullptr: only std/ imports
  CompileLimits limits;
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();  ///< must outlive the Program
};

struct SourceFile {
  std::string path, text;
};

}  // namespace sgm
