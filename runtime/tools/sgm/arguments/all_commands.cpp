// List of the commands of a full build (SGM_TOOLS=all).

#include "tools/sgm/arguments/add_commands.h"

namespace sgm::cli {
namespace {

constexpr AddCommand kAll[] = {addCheck,   addFmt,      addExplain, addMesh,   addBake,    addStore,
                               addMeasure, addClassify, addMasters, addRender, addPreview, addFly,
                               addServe,   addInspect,  addLsp,     addBench,  addPaper,   addBackends};

}  // namespace

std::span<const AddCommand> commandsToAdd() { return kAll; }

std::span<const std::string_view> commandsLeftOut() { return {}; }

}  // namespace sgm::cli
