#include "chunk/chunk_part.h"

#include <algorithm>

#include "base/bytes.h"
#include "chunk/chunk_codec.h"
#include "mesh/feature_kind.h"

namespace sgm {
namespace {

constexpr size_t kAnchorBytes = 3 * 4 + 9 * 4 + 3 * 2 + 8;

uint8_t seamBit(int part) { return part == 0 ? uint8_t{0} : static_cast<uint8_t>(1 << (part - 1)); }

void putBrushes(std::span<const Brush> brushes, std::vector<std::byte>& bytes) {
  ByteWriter(bytes).put(uint64_t{brushes.size()});
  for (const Brush& brush : brushes) encodeBrush(brush, bytes);
}

void putAnchor(const Anchor& anchor, ByteWriter& out) {
  for (int axis = 0; axis < 3; ++axis) out.put(anchor.frame.origin[axis]);
  for (float row : anchor.frame.rows) out.put(row);
  out.put(anchor.kind);
  out.put(anchor.name);
  out.put(anchor.tag);
  out.put(anchor.key.value);
}

Anchor getAnchor(ByteReader& in) {
  Anchor anchor;
  for (int axis = 0; axis < 3; ++axis) anchor.frame.origin[axis] = in.get<int32_t>();
  for (float& row : anchor.frame.rows) row = in.get<float>();
  anchor.kind = in.get<uint16_t>();
  anchor.name = in.get<uint16_t>();
  anchor.tag = in.get<uint16_t>();
  anchor.key.value = in.get<uint64_t>();
  return anchor;
}

bool isKindOf(int part, bool sharp, uint16_t kind) {
  if (isFeature(kind)) return sharp && (part != 0 || !isOfCoarserLevel(kind));
  return kind <= (part == 0 ? kOwnEdge : kLateralEdge);
}

/// Decodes the anchors and voids that are stored after the mesh of a body.
bool getExtra(std::span<const std::byte> bytes, const ChunkPartInputs& inputs, ChunkPart& part) {
  ByteReader in(bytes);
  const auto anchors = in.get<uint32_t>();
  if (in.failed() || anchors > in.left() / kAnchorBytes || (anchors != 0 && !inputs.request().anchors)) return false;
  part.anchors.reserve(anchors);
  for (uint32_t i = 0; i < anchors; ++i) {
    const Anchor a = getAnchor(in);
    if (!inputs.box().contains(a.frame.origin)) return false;
    if (!inputs.isName(a.kind) || !inputs.isName(a.name) || !inputs.isTag(a.tag)) return false;
    part.anchors.push_back(a);
  }
  const size_t voids = in.left() / sizeof(VoidComponent);
  if (voids > kMaxVoidComponents || (voids != 0 && !inputs.request().signs)) return false;
  part.voids.resize(voids);
  for (VoidComponent& component : part.voids) {
    for (uint64_t& face : component.faces) face = in.get<uint64_t>();
    for (uint64_t& block : component.blocks) block = in.get<uint64_t>();
  }
  return in.left() == 0;
}

std::optional<std::vector<std::byte>> bakedInputs(std::optional<std::vector<std::byte>> identity, bool sharp) {
  if (!identity) return std::nullopt;
  ByteWriter out(*identity);
  out.put(kMeshingVersion);
  out.put(kChunkCodecVersion);
  out.put(static_cast<uint8_t>(sharp));
  return identity;
}

}  // namespace

bool asksFor(const ChunkRequest& request, int part) {
  return part == 0 ? request.body : (request.seams & seamBit(part)) != 0;
}

std::optional<std::vector<std::byte>> bakedWorldInputs(const WorldField& world, bool sharp) {
  return bakedInputs(world.identity(), sharp);
}

std::optional<std::vector<std::byte>> formerBakedWorldInputs(const WorldField& world, bool sharp) {
  return bakedInputs(world.formerIdentity(), sharp);
}

std::optional<ChunkPartInputs> ChunkPartInputs::of(const WorldField& world, const ChunkRequest& request,
                                                   const EditSnapshot* edits) {
  std::optional<std::vector<std::byte>> identity = world.identity();
  if (!identity) return std::nullopt;
  return ChunkPartInputs(world, request, edits, std::move(*identity));
}

ChunkPartInputs::ChunkPartInputs(const WorldField& world, const ChunkRequest& request, const EditSnapshot* edits,
                                 std::vector<std::byte>&& identity)
    : request_(request),
      box_(chunkBox(*chunkGrid(world, request.key))),
      program_(world.settings().program),
      identity_(std::move(identity)),
      brushes_(world.memory()),
      coarser_(world.memory()) {
  const ChunkGrid grid = *chunkGrid(world, request.key);
  const auto around = [&](int level) { return world.brushes(sampledBox(grid, level, request.sharp), level, edits); };
  brushes_ = around(grid.level);
  // The field beyond the meshed world has no brushes, so the seams of an outermost chunk do not depend on brushes of
  // the coarser level.
  if (request.seams != 0 && !request.outermost) coarser_ = around(grid.level + 1);
}

std::vector<std::byte> ChunkPartInputs::bytes(int part) const {
  const bool body = part == 0;
  std::vector<std::byte> bytes = identity_;
  ByteWriter out(bytes);
  out.put(kMeshingVersion);
  out.put(kChunkCodecVersion);
  out.put(request_.key.level);
  for (int axis = 0; axis < 3; ++axis) out.put(request_.key.at[axis]);
  out.put(part);
  // ChunkRequest::coarser is left out: it affects only the keys of vertices, and these keys are not stored.
  for (const bool asked :
       {body && request_.signs, body && request_.anchors, !body && request_.outermost, request_.sharp}) {
    out.put(static_cast<uint8_t>(asked));
  }
  putBrushes(brushes_, bytes);
  if (!body) putBrushes(coarser_, bytes);
  return bytes;
}

bool ChunkPartInputs::isAsBaked(int part) const {
  if (!brushes_.empty()) return false;
  if (part != 0) return coarser_.empty() && !request_.outermost;
  return request_.key.level == 0 || (!request_.anchors && !request_.signs);
}

ChunkPartInputs ChunkPartInputs::asBaked() const {
  ChunkPartInputs baked = *this;
  baked.request_.anchors = baked.request_.signs = request_.key.level == 0;
  return baked;
}

bool ChunkPartInputs::isOfBrush(uint16_t number, uint16_t Brush::*member) const {
  const auto has = [&](const Brush& brush) { return brush.*member == number; };
  return std::any_of(brushes_.begin(), brushes_.end(), has) || std::any_of(coarser_.begin(), coarser_.end(), has);
}

bool ChunkPartInputs::isMaterial(uint16_t number) const {
  return number < program_->materials.size() || isOfBrush(number, &Brush::material);
}

bool ChunkPartInputs::isTag(uint16_t number) const {
  return number < program_->tags.size() || isOfBrush(number, &Brush::tag);
}

std::pmr::vector<std::byte> encodeChunkPart(int part, const MeshPart& mesh, std::span<const Anchor> anchors,
                                            std::span<const VoidComponent> voids, std::pmr::memory_resource* memory) {
  MeshParts parts{};
  parts[static_cast<size_t>(part)] = &mesh;
  ChunkRecord record(memory);
  record.mesh = packMesh(parts, nullptr, memory);
  record.seams = seamBit(part);
  if (part == 0) {
    std::vector<std::byte> extra;
    ByteWriter out(extra);
    out.put(static_cast<uint32_t>(anchors.size()));
    for (const Anchor& anchor : anchors) putAnchor(anchor, out);
    for (const VoidComponent& component : voids) {
      for (uint64_t face : component.faces) out.put(face);
      for (uint64_t block : component.blocks) out.put(block);
    }
    record.extra.assign(extra.begin(), extra.end());
  }
  return encodeChunk(record, memory);
}

std::optional<ChunkPart> decodeChunkPart(std::span<const std::byte> bytes, int part, const ChunkPartInputs& inputs,
                                         std::pmr::memory_resource* memory, BytesAre are) {
  Result<ChunkRecord> record = decodeChunk(bytes, memory);
  if (!record || record->seams != seamBit(part)) return std::nullopt;
  PackedMesh& mesh = record->mesh;
  const PackedRange& range = mesh.ranges[static_cast<size_t>(part)];
  if (range.vertex_count != mesh.vertices.size() || range.index_count != mesh.indices.size()) return std::nullopt;
  const auto sound = [&](const Vertex& v) {
    return isKindOf(part, inputs.request().sharp, v.kind) && inputs.isMaterial(v.material) && inputs.isTag(v.tag);
  };
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), sound)) return std::nullopt;
  ChunkPart found(memory);
  found.mesh.vertices = std::move(mesh.vertices);
  found.mesh.indices = std::move(mesh.indices);
  if (are == BytesAre::whole) {
    found.mesh.hash = range.hash;
  } else {
    hashPart(found.mesh);
  }
  if (found.mesh.hash != range.hash) return std::nullopt;
  if (part == 0 ? !getExtra(record->extra, inputs, found) : !record->extra.empty()) return std::nullopt;
  return found;
}

}  // namespace sgm
