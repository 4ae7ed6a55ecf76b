#pragma once
// Reads imported assets: converts .glb bytes to closed polyhedra with planar faces.

#include <cstdint>
#include <optional>
#include <string_view>

#include "grammar/syntax/program.h"
#include "grammar/text/sink.h"

namespace sgm {

/// Reads an asset and adds it to Program::assets. Notes of the reader become warnings at `span`. Returns the asset's
/// index, or nullopt after reporting an error at `span` if the asset is invalid.
std::optional<uint32_t> addAsset(Program& program, std::string_view path, std::string_view bytes, const Span& span,
                                 DiagnosticSink& sink);

}  // namespace sgm
