#pragma once
// Assets that a grammar imports: their bytes to closed bodies of plane faces.

#include <cstdint>
#include <optional>
#include <string_view>

#include "grammar/program.h"
#include "grammar/sink.h"

namespace sgm {

/// Reads the asset of that path and puts it into Program::assets. Nothing, with an error at `span`, where it is none.
std::optional<uint32_t> addAsset(Program& program, std::string_view path, std::string_view bytes, const Span& span,
                                 DiagnosticSink& sink);

}  // namespace sgm
