#include <algorithm>
#include <cstring>

#include "api/barrier.h"
#include "api/world.h"

using namespace sgm::api;

namespace {

sgm::Int3 placeOf(const int32_t (&p)[3]) { return {p[0], p[1], p[2]}; }

sgm::Brush brushOf(const sgm_brush& brush) {
  sgm::Brush b;
  b.shape = static_cast<sgm::Brush::Shape>(brush.shape);
  b.cut = brush.cut != 0;
  b.material = brush.material;
  b.tag = brush.tag;
  b.from = placeOf(brush.from);
  b.to = placeOf(brush.to);
  b.half = placeOf(brush.half);
  std::copy_n(brush.turn, b.turn.size(), b.turn.begin());
  b.radius = brush.radius;
  b.smooth = brush.smooth;
  return b;
}

void writeId(sgm_edit_id* out, const sgm::EditId& id) {
  if (out != nullptr) *out = {id.author, id.number};
}

}  // namespace

sgm_result sgm_world_edit(sgm_world* world, const sgm_brush* brush, sgm_edit_id* id, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    writeId(id, {});
    if (world == nullptr) return nullArgument(error, "world");
    if (brush == nullptr) return nullArgument(error, "brush");
    if (brush->shape < SGM_BRUSH_SPHERE || brush->shape > SGM_BRUSH_CAPSULE)
      return fail(error, SGM_ERR_INVALID_ARGUMENT, "brush.shape is not a valid sgm_brush_shape");
    const sgm::Result<sgm::EditId> made = world->world->edit(brushOf(*brush));
    if (!made) return failLogged(*world, error, made.error());
    writeId(id, *made);
    return SGM_OK;
  });
}

sgm_result sgm_world_undo(sgm_world* world, const sgm_edit_id* id, sgm_edit_id* undone, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    // The id is copied before `undone` is written, because the caller may pass the same object for both.
    const sgm_edit_id of = id != nullptr ? *id : sgm_edit_id{};
    writeId(undone, {});
    if (world == nullptr) return nullArgument(error, "world");
    if (id == nullptr) return nullArgument(error, "id");
    const sgm::Result<sgm::EditId> made = world->world->undo({of.author, of.number});
    if (!made && made.error().code == sgm::Code::invalid_argument)
      return fail(error, SGM_ERR_NOT_FOUND, made.error().message);
    if (!made) return failLogged(*world, error, made.error());
    writeId(undone, *made);
    return SGM_OK;
  });
}

sgm_result sgm_world_export_edits(sgm_world* world, uint64_t since, void* bytes, size_t* count, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (count == nullptr) return nullArgument(error, "count");
    if (world == nullptr) return nullArgument(error, "world");
    const std::vector<std::byte> all = world->world->exportEdits(since);
    const size_t room = *count;
    *count = all.size();
    if (bytes == nullptr) return SGM_OK;
    if (room < all.size()) return SGM_INCOMPLETE;
    std::memcpy(bytes, all.data(), all.size());
    return SGM_OK;
  });
}

sgm_result sgm_world_import_edits(sgm_world* world, const void* bytes, size_t count, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    if (bytes == nullptr) return nullArgument(error, "bytes");
    const sgm::Result<void> taken = world->world->importEdits({static_cast<const std::byte*>(bytes), count});
    return taken ? SGM_OK : failLogged(*world, error, taken.error());
  });
}

sgm_result sgm_world_flush_edits(sgm_world* world, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    const sgm::Result<void> flushed = world->world->flushEdits();
    return flushed ? SGM_OK : failLogged(*world, error, flushed.error());
  });
}

uint64_t sgm_world_edits_hash(const sgm_world* world) { return world != nullptr ? world->world->editHash() : 0; }
