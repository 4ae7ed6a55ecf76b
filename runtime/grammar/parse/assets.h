#pragma once
// Reads assets that a grammar imports: bytes to closed bodies with planar faces.

#include <cstdint>
#include <optional>
#include <string_view>

#include "grammar/syntax/program.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Reads the asset and adds it to Program::assets; the reader's notes become warnings at `span`. nullopt, after an
/// error there, if it is not a valid asset.
std::optional<uint32_t> addAsset(Program& program, std::string_view path, std::string_view bytes, const Span& span,
                                 DiagnosticSink& sink);

}  // namespace sgm
