#include <algorithm>

#include "api/barrier.h"
#include "api/field.h"
#include "api/world.h"
#include "query/void_path.h"

using namespace sgm::api;

namespace {

static_assert(static_cast<int>(sgm::WayVerdict::found) == SGM_WAY_FOUND &&
              static_cast<int>(sgm::WayVerdict::from_in_rock) == SGM_WAY_FROM_IN_ROCK &&
              static_cast<int>(sgm::WayVerdict::to_in_rock) == SGM_WAY_TO_IN_ROCK &&
              static_cast<int>(sgm::WayVerdict::from_too_narrow) == SGM_WAY_FROM_TOO_NARROW &&
              static_cast<int>(sgm::WayVerdict::to_too_narrow) == SGM_WAY_TO_TOO_NARROW &&
              static_cast<int>(sgm::WayVerdict::apart) == SGM_WAY_APART);

sgm_result takeQuestion(sgm_error* error, const sgm_way_desc& desc, sgm::VoidQuestion& question) {
  if ((desc.flags & ~static_cast<uint32_t>(SGM_WAY_WIDEST)) != 0)
    return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.flags has unknown bits: pass 0 or values of sgm_way_flag");
  if (desc.reserved != 0) return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.reserved must be 0");
  question.ends = sgm::VoidQuestion::Ends();
  for (int axis = 0; axis < 3; ++axis) {
    if (desc.minimum[axis] >= desc.maximum[axis])
      return fail(error, SGM_ERR_INVALID_ARGUMENT, "desc.minimum must be below desc.maximum on every axis");
    question.region.lo[axis] = desc.minimum[axis];
    question.region.hi[axis] = desc.maximum[axis];
    const auto a = static_cast<size_t>(axis);
    question.ends->from[a] = desc.from[axis];
    question.ends->to[a] = desc.to[axis];
  }
  question.ends->widest = (desc.flags & SGM_WAY_WIDEST) != 0;
  question.radius = desc.radius * kUnits;
  question.max_chunks = desc.max_chunks != 0 ? desc.max_chunks : kDefaultMostChunks;
  return SGM_OK;
}

/// Writes the result of a path search to `out`; keeps struct_size and next of `out`.
void writeWay(const sgm::VoidAnswer& answer, sgm_way& out) {
  const sgm::VoidWay& way = *answer.way;
  const auto volume = [&](uint64_t samples) { return static_cast<double>(samples) * answer.sample; };
  out = SGM_WAY_INIT;
  out.verdict = static_cast<int32_t>(way.verdict);
  out.place_count = way.places.size();
  out.length = way.length / kUnits;
  out.from_clearance = way.from_clearance / kUnits;
  out.to_clearance = way.to_clearance / kUnits;
  out.widest = way.widest / kUnits;
  out.from_volume = volume(way.from_samples);
  out.to_volume = volume(way.to_samples);
  out.largest_volume = answer.voids.empty() ? 0 : volume(answer.voids[0].samples);
  out.void_count = answer.voids.size();
  out.sealed_count = static_cast<uint64_t>(std::ranges::count(answer.voids, true, &sgm::RegionVoid::sealed));
}

sgm_result findWay(sgm_error* error, const sgm::QueryField& asked, sgm_runtime& runtime, const sgm_way_desc* desc,
                   sgm_way* out) {
  if (sgm_result r = checkDesc(error, desc, "desc"); r != SGM_OK) return r;
  if (sgm_result r = checkDesc(error, out, "out"); r != SGM_OK) return r;
  sgm::VoidQuestion question;
  if (sgm_result r = takeQuestion(error, *desc, question); r != SGM_OK) return r;
  sgm::Progress progress;
  if (desc->progress != nullptr)
    progress = [desc](uint64_t done, uint64_t total) { return desc->progress(desc->progress_user, done, total) == 0; };
  const sgm::SignField field = sgm::signField(asked);
  const sgm::Result<sgm::VoidAnswer> answer = sgm::findVoids(field, *runtime.jobs, question, progress);
  if (!answer) return fail(error, answer.error());
  writeWay(*answer, *out);
  if (desc->places == nullptr) return SGM_OK;
  const std::vector<sgm::Int3>& places = answer->way->places;
  const size_t written = std::min(places.size(), desc->place_room);
  for (size_t i = 0; i < written; ++i) {
    for (int axis = 0; axis < 3; ++axis) desc->places[3 * i + static_cast<size_t>(axis)] = places[i][axis];
  }
  return written < places.size() ? SGM_INCOMPLETE : SGM_OK;
}

}  // namespace

sgm_result sgm_field_find_way(sgm_field* field, const sgm_way_desc* desc, sgm_way* out, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (field == nullptr) return nullArgument(error, "field");
    return findWay(error, sgm::queryField(field->content->world), field->runtime, desc, out);
  });
}

sgm_result sgm_world_find_way(sgm_world* world, const sgm_way_desc* desc, sgm_way* out, sgm_error* error) {
  return guarded(error, [&]() -> sgm_result {
    if (world == nullptr) return nullArgument(error, "world");
    return findWay(error, world->world->queryField(), world->runtime, desc, out);
  });
}
