#pragma once
// Assets that a grammar imports: their bytes to closed bodies of plane faces.

#include <cstdint>
#include <optional>
#include <string_view>

#include "grammar/syntax/program.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Reads the asset of that path and puts it into Program::assets; the notes of its reader become warnings at `span`.
/// nullopt, with an error there, if it is not an asset.
std::optional<uint32_t> addAsset(Program& program, std::string_view path, std::string_view bytes, const Span& span,
                                 DiagnosticSink& sink);

}  // namespace sgm
