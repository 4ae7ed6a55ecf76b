#include "tools/render/ray_caster.h"

#include <embree3/rtcore.h>

#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tools/render/puff_noise.h"

namespace sgm {
namespace {

const Error kNoMemory{Code::out_of_memory, "out of memory while preparing a mesh for rays"};

bool meetsFront(const RTCFilterFunctionNArguments& at) {
  const RTCRay& ray = *reinterpret_cast<const RTCRay*>(at.ray);
  const RTCHit& hit = *reinterpret_cast<const RTCHit*>(at.hit);
  return ray.dir_x * hit.Ng_x + ray.dir_y * hit.Ng_y + ray.dir_z * hit.Ng_z < 0;
}

// Embree filter function, called for each hit: rejects hits on the back of a triangle.
void dropBack(const RTCFilterFunctionNArguments* at) {
  if (!meetsFront(*at)) at->valid[0] = 0;
}
void dropFront(const RTCFilterFunctionNArguments* at) {
  if (meetsFront(*at)) at->valid[0] = 0;
}

/// Embree's context for a shadow ray, extended by the data that the filter function needs.
struct LightRay {
  RTCIntersectContext context;  // must be the first member: Embree passes only a pointer to this context, from which
                                // the filter function gets the LightRay
  const RayCaster* mesh;
  std::span<const LetsLight> lets;
  glm::vec3 offset;
};

// Embree filter function of shadow rays: rejects hits on the front of a triangle, in gaps between leaves, and on
// materials that always transmit light.
void dropFrontAndGaps(const RTCFilterFunctionNArguments* at) {
  if (meetsFront(*at)) {
    at->valid[0] = 0;
    return;
  }
  const auto& light = *reinterpret_cast<const LightRay*>(at->context);
  const RTCRay& ray = *reinterpret_cast<const RTCRay*>(at->ray);
  const RTCHit& hit = *reinterpret_cast<const RTCHit*>(at->hit);
  const uint32_t material = light.mesh->vertex(hit.primID, 0).material;
  if (material >= light.lets.size() || light.lets[material] == LetsLight::never) return;
  if (light.lets[material] == LetsLight::always) {
    at->valid[0] = 0;
    return;
  }
  constexpr float kSprig = 0.5f, kGap = 0.60f;  // kSprig: period of the noise in metres; where the noise exceeds kGap,
                                                // the foliage has a gap
  const glm::vec3 place =
      glm::vec3(ray.org_x, ray.org_y, ray.org_z) + ray.tfar * glm::vec3(ray.dir_x, ray.dir_y, ray.dir_z);
  if (puffHollows(place + light.offset, kSprig, 0.1f) > kGap) at->valid[0] = 0;
}

template <class Ray>
void aim(Ray& ray, glm::vec3 from, glm::vec3 direction, float max_distance) {
  ray.org_x = from.x;
  ray.org_y = from.y;
  ray.org_z = from.z;
  ray.tnear = 0;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tfar = max_distance;
  ray.time = 0;
  ray.mask = ~0u;
  ray.id = 0;
  ray.flags = 0;
}

std::optional<RayHit> nearest(RTCScene scene, glm::vec3 from, glm::vec3 direction, float max_distance, bool fronts) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (fronts) context.filter = dropBack;
  RTCRayHit met{};
  aim(met.ray, from, direction, max_distance);
  met.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  met.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &met);
  if (met.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const float along = direction.x * met.hit.Ng_x + direction.y * met.hit.Ng_y + direction.z * met.hit.Ng_z;
  return RayHit{met.ray.tfar, along < 0, met.hit.primID,
                met.hit.u,    met.hit.v, {met.hit.Ng_x, met.hit.Ng_y, met.hit.Ng_z}};
}

}  // namespace

void RayCaster::Release::operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }

Result<RayCaster> RayCaster::over(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices,
                                  Gaps gaps) {
  RayCaster caster(vertices, indices);
  for (const uint32_t index : indices) {
    caster.lo_ = glm::min(caster.lo_, vertices[index].position);
    caster.hi_ = glm::max(caster.hi_, vertices[index].position);
  }
  // Build Embree's tree with one thread, so that the tree, and thus each picture, is reproducible.
  const RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  if (!device) return kNoMemory;
  caster.scene_.reset(rtcNewScene(device));
  const RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (caster.scene_ && mesh && !indices.empty()) {
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(),
                               offsetof(RenderVertex, position), sizeof(RenderVertex), vertices.size());
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0,
                               3 * sizeof(uint32_t), indices.size() / 3);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(caster.scene_.get(), mesh);
    // The flag RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION is needed because shadow rays have a filter function of their
    // own: without the flag, Embree ignores filter functions that are set for a single ray.
    const RTCSceneFlags closed = gaps == Gaps::closed ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE;
    rtcSetSceneFlags(caster.scene_.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION | closed));
  }
  if (caster.scene_) rtcCommitScene(caster.scene_.get());
  if (mesh) rtcReleaseGeometry(mesh);
  const bool failed = !mesh || rtcGetDeviceError(device) != RTC_ERROR_NONE;
  rtcReleaseDevice(device);
  if (failed || !caster.scene_) return kNoMemory;
  return caster;
}

glm::vec3 RayCaster::facing(uint32_t triangle) const {
  return glm::cross(corner(triangle, 1) - corner(triangle, 0), corner(triangle, 2) - corner(triangle, 0));
}

std::optional<RayHit> RayCaster::cast(glm::vec3 from, glm::vec3 direction, float max_distance) const {
  return nearest(scene_.get(), from, direction, max_distance, false);
}

std::optional<RayHit> RayCaster::castFronts(glm::vec3 from, glm::vec3 direction, float max_distance) const {
  return nearest(scene_.get(), from, direction, max_distance, true);
}

void RayCaster::loosen(std::span<const LetsLight> lets, glm::vec3 offset) {
  lets_ = lets;
  offset_ = offset;
}

bool RayCaster::isFree(glm::vec3 from, glm::vec3 direction, float max_distance) const {
  LightRay light{{}, this, lets_, offset_};
  rtcInitIntersectContext(&light.context);
  light.context.filter = lets_.empty() ? dropFront : dropFrontAndGaps;
  RTCRay ray{};
  aim(ray, from, direction, max_distance);
  rtcOccluded1(scene_.get(), &light.context, &ray);
  return ray.tfar >= 0;  // Embree sets tfar to -infinity if the ray is blocked
}

}  // namespace sgm
