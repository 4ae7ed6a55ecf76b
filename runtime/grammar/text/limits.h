#pragma once
// The options and the limits of a compilation. Limits are needed since grammar text is untrusted.

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <string>
#include <string_view>

#include "base/result.h"

namespace sgm {

/// Reads imported grammar files and assets. The compiler passes only valid paths: relative to the root file's folder,
/// with forward slashes, without empty parts, "." or "..", without a drive, ending in ".sgm" or ".glb", at most 255
/// bytes. A resolver that reads from a disk must also reject links that lead out of the folder. Called only on the
/// compiling thread.
class ImportResolver {
 public:
  virtual ~ImportResolver() = default;
  /// Returns the content of a file. Errors: io if it does not exist; limit if it is longer than `limit` bytes.
  virtual Result<std::string> read(std::string_view path, size_t limit) = 0;
};

struct CompileLimits {
  size_t text_bytes = 1u << 20;          ///< maximum number of bytes of one grammar file
  size_t total_bytes = 4u << 20;         ///< maximum number of bytes of all grammar files together
  size_t asset_bytes = 16u << 20;        ///< maximum number of bytes of one asset
  size_t total_asset_bytes = 64u << 20;  ///< maximum number of bytes of all assets together
  uint32_t files = 64;                   ///< maximum number of grammar files; the same limit applies to assets
  uint32_t import_depth = 16;
  uint32_t nesting = 64;            ///< maximum nesting depth of blocks, and of expressions
  uint32_t nodes = 1u << 20;        ///< maximum number of tokens, and of expressions and statements together
  uint32_t diagnostics = 50;        ///< number of errors after which the compiler stops
  uint32_t bound_steps = 1u << 18;  ///< maximum number of steps in one attempt to evaluate the rules with intervals of
                                    ///< values
  int32_t neighbours = 4;           ///< maximum number of cells that a layer's reach may span on each side
};

struct CompileOptions {
  ImportResolver* resolver = nullptr;  ///< nullptr: only imports of "std/..." are available
  CompileLimits limits;
  /// allocates the memory of the Program; must outlive the Program
  std::pmr::memory_resource* memory = std::pmr::get_default_resource();
};

struct SourceFile {
  std::string path, text;
};

}  // namespace sgm
