// List of the commands of a small build (SGM_TOOLS=core).

#include "tools/sgm/arguments/add_commands.h"

namespace sgm::cli {
namespace {

constexpr AddCommand kCore[] = {addCheck, addFmt, addExplain, addMesh, addMeasure, addRender, addFly, addBackends};
constexpr std::string_view kLeftOut[] = {"bake",  "store",   "classify", "masters", "preview",
                                         "serve", "inspect", "lsp",      "bench",   "paper"};

}  // namespace

std::span<const AddCommand> commandsToAdd() { return kCore; }

std::span<const std::string_view> commandsLeftOut() { return kLeftOut; }

}  // namespace sgm::cli
