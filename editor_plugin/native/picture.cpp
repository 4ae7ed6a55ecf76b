#include "picture.h"

#include <atomic>
#include <chrono>
#include <tuple>

#include "godot/log.h"

namespace sgm_godot {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::shared_ptr<sgm_mesh> owned(sgm_mesh* mesh) { return {mesh, EndWith<sgm_mesh_release>()}; }

}  // namespace

struct Picture::Upload {
  Plugin& plugin;
  std::shared_ptr<sgm_mesh> mesh;
  Part part;
  std::vector<uint16_t> slots;  // a copy, because Look may change while the background thread works
  std::vector<PackedSurface> surfaces;
  std::atomic<bool> packed{false};
  bool uploaded = false, visible = false;
  int32_t origin[3] = {};
  size_t triangles = 0;
  Rid rid, instance;

  Upload(Plugin& of, std::shared_ptr<sgm_mesh> from, Part which, std::vector<uint16_t> with)
      : plugin(of), mesh(std::move(from)), part(which), slots(std::move(with)) {}
};

Picture::Picture(Plugin& plugin, Look look) : plugin_(plugin), look_(std::move(look)) {}

Picture::~Picture() {
  for (auto& [key, chunk] : chunks_) {
    drop(chunk.body);
    drop(chunk.seams);
  }
  for (Frame& frame : frames_) {
    for (Step& step : frame) {
      drop(step.body);
      drop(step.seams);
    }
  }
  for (auto& [key, body] : ready_) drop(body);
}

Picture::UploadOwner Picture::submit(const std::shared_ptr<sgm_mesh>& mesh, Part part) {
  auto made = std::make_shared<Upload>(plugin_, mesh, part, look_.slots);
  uploads_.push_back(made);
  plugin_.background->run([made] {
    sgm_mesh_view view = SGM_MESH_VIEW_INIT;
    if (sgm_mesh_get_view(made->mesh.get(), &view, nullptr) == SGM_OK) {
      try {
        made->surfaces = packSurfaces(view, made->part, made->slots);
      } catch (const std::bad_alloc&) {
        made->surfaces.clear();
        logOutOfMemory("out of memory: a chunk is not drawn");
      }
      std::copy_n(view.origin, 3, made->origin);
    }
    made->packed.store(true, std::memory_order_release);
  });
  return made;
}

void Picture::take(const std::vector<sgm_world_event>& events) {
  Frame frame;
  for (const sgm_world_event& event : events) {
    switch (event.kind) {
      case SGM_EVENT_READY: {
        std::shared_ptr<sgm_mesh> mesh = owned(event.mesh);
        if (const auto old = ready_.find(event.key); old != ready_.end()) drop(old->second);
        ready_[event.key] = submit(mesh, {true, 0});
        known_[event.key] = std::move(mesh);
        break;
      }
      case SGM_EVENT_SHOWN:
      case SGM_EVENT_REPLACED: {
        Step step{event.kind, event.key, known_[event.key], nullptr, nullptr, event.seams};
        if (const auto body = ready_.find(event.key); body != ready_.end()) {
          step.body = std::move(body->second);
          ready_.erase(body);
        }
        step.seams = submit(step.mesh, {false, event.seams});
        frame.push_back(std::move(step));
        break;
      }
      case SGM_EVENT_SEAMS: {
        const std::shared_ptr<sgm_mesh>& mesh = known_[event.key];
        frame.push_back({event.kind, event.key, mesh, nullptr, submit(mesh, {false, event.seams}), event.seams});
        break;
      }
      case SGM_EVENT_REMOVED:
        known_.erase(event.key);
        if (const auto body = ready_.find(event.key); body != ready_.end()) {
          drop(body->second);
          ready_.erase(body);
        }
        frame.push_back({event.kind, event.key, nullptr, nullptr, nullptr, 0});
        break;
      default:
        break;
    }
  }
  if (!frame.empty()) frames_.push_back(std::move(frame));
}

void Picture::takeDrawn(const std::vector<sgm_drawn_chunk>& chunks, const Picture& before) {
  for (const auto& [key, body] : before.ready_) {
    known_[key] = body->mesh;
    ready_[key] = submit(body->mesh, {true, 0});
  }
  Frame frame;
  for (const sgm_drawn_chunk& chunk : chunks) {
    std::shared_ptr<sgm_mesh> mesh = owned(chunk.mesh);
    known_.emplace(chunk.key, mesh);  // emplace() keeps a mesh that a READY event has already stored for this key
    frame.push_back(
        {SGM_EVENT_SHOWN, chunk.key, mesh, submit(mesh, {true, 0}), submit(mesh, {false, chunk.seams}), chunk.seams});
  }
  for (const auto& [key, chunk] : before.chunks_) {
    const auto is = [&key](const sgm_drawn_chunk& drawn) {
      return !KeyLess()(drawn.key, key) && !KeyLess()(key, drawn.key);
    };
    if (std::none_of(chunks.begin(), chunks.end(), is)) gone_.push_back(key);
  }
  if (!frame.empty()) frames_.push_back(std::move(frame));
}

void Picture::upload(Upload& upload) {
  upload.uploaded = true;
  if (upload.surfaces.empty()) return;
  std::vector<Variant> surfaces;
  for (const PackedSurface& packed : upload.surfaces) {
    surfaces.push_back(packed.surface);
    upload.triangles += packed.triangles;
  }
  const Rendering& rendering = *plugin_.rendering;
  upload.rid = rendering.createMesh(surfaces);
  for (size_t i = 0; i < upload.surfaces.size(); ++i) {
    const uint16_t slot = upload.surfaces[i].slot;
    if (slot < look_.materials.size())
      rendering.setMaterial(upload.rid, static_cast<int64_t>(i), look_.materials[slot]);
  }
  upload.instance = rendering.createInstance(upload.rid, look_.scenario, look_.placement.ofCorner(upload.origin));
  rendering.setShadow(upload.instance, look_.shadow);
  rendering.setLayers(upload.instance, look_.layers);
  if (look_.owner != nullptr) rendering.attach(upload.instance, look_.owner);
  // the engine has copied the arrays, so they are freed
  for (PackedSurface& packed : upload.surfaces) packed.surface = Variant();
}

void Picture::show(const UploadOwner& upload, bool visible) {
  if (!upload || !upload->instance || upload->visible == visible) return;
  upload->visible = visible;
  plugin_.rendering->setVisible(upload->instance, visible && look_.visible);
  visible ? triangles_ += upload->triangles : triangles_ -= upload->triangles;
}

void Picture::drop(UploadOwner& upload) {
  if (!upload) return;
  show(upload, false);
  plugin_.rendering->free(upload->instance);
  plugin_.rendering->free(upload->rid);
  upload->instance = upload->rid = Rid();
  // If the part is still in the queue of uploads, marking it as uploaded makes the queue skip it.
  upload->uploaded = true;
  upload.reset();
}

void Picture::apply(Frame& frame, std::vector<Change>& changes) {
  for (Step& step : frame) {
    if (step.kind == SGM_EVENT_REMOVED) {
      const auto found = chunks_.find(step.key);
      if (found == chunks_.end()) continue;  // a removed chunk may have been READY without ever being shown
      drop(found->second.body);
      drop(found->second.seams);
      chunks_.erase(found);
      changes.push_back({Change::kRemoved, step.key, nullptr});
      continue;
    }
    Chunk& chunk = chunks_[step.key];
    if (step.body) {
      drop(chunk.body);
      chunk.body = std::move(step.body);
      show(chunk.body, true);
    }
    drop(chunk.seams);
    chunk.seams = std::move(step.seams);
    show(chunk.seams, true);
    chunk.mesh = step.mesh;
    chunk.mask = step.mask;
    if (step.kind == SGM_EVENT_SEAMS) continue;
    changes.push_back(
        {step.kind == SGM_EVENT_SHOWN ? Change::kShown : Change::kReplaced, step.key, acquired(step.mesh.get())});
  }
}

std::vector<Picture::Change> Picture::advance(double seconds) {
  const Clock::time_point start = Clock::now();
  std::vector<Change> changes;
  for (const sgm_chunk_key& key : std::exchange(gone_, {})) changes.push_back({Change::kRemoved, key, nullptr});
  bool one = false;
  while (!uploads_.empty()) {
    Upload& next = *uploads_.front();
    if (!next.uploaded) {
      if (!next.packed.load(std::memory_order_acquire)) break;
      if (one && secondsSince(start) >= seconds) break;
      upload(next);
      one = true;
    }
    uploads_.pop_front();
  }
  const auto complete = [](const Frame& frame) {
    for (const Step& step : frame) {
      if ((step.body && !step.body->uploaded) || (step.seams && !step.seams->uploaded)) return false;
    }
    return true;
  };
  while (!frames_.empty() && complete(frames_.front())) {
    apply(frames_.front(), changes);
    frames_.pop_front();
  }
  return changes;
}

std::vector<Picture::Change> Picture::finish() {
  std::vector<Change> changes;
  while (!frames_.empty()) {
    for (Change& change : advance(1)) changes.push_back(std::move(change));
    if (!frames_.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return changes;
}

template <class Visit>
void Picture::eachUploaded(const Visit& visit) {
  const auto look = [&](const UploadOwner& part) {
    if (part && part->instance) visit(*part);
  };
  for (const auto& [key, chunk] : chunks_) {
    look(chunk.body);
    look(chunk.seams);
  }
  for (const Frame& frame : frames_) {
    for (const Step& step : frame) {
      look(step.body);
      look(step.seams);
    }
  }
  for (const auto& [key, body] : ready_) look(body);
}

void Picture::setPlacement(const Placement& placement) {
  look_.placement = placement;
  eachUploaded([&](Upload& part) { plugin_.rendering->setPlace(part.instance, placement.ofCorner(part.origin)); });
}

void Picture::setMaterials(const std::vector<Rid>& materials) {
  look_.materials = materials;
  eachUploaded([&](Upload& part) {
    for (size_t i = 0; i < part.surfaces.size(); ++i) {
      const uint16_t slot = part.surfaces[i].slot;
      if (slot < materials.size()) plugin_.rendering->setMaterial(part.rid, static_cast<int64_t>(i), materials[slot]);
    }
  });
}

void Picture::setLook(bool shadow, bool visible, int64_t layers) {
  look_.shadow = shadow;
  look_.visible = visible;
  look_.layers = layers;
  eachUploaded([&](Upload& part) {
    plugin_.rendering->setShadow(part.instance, shadow);
    plugin_.rendering->setLayers(part.instance, layers);
    plugin_.rendering->setVisible(part.instance, part.visible && visible);
  });
}

std::vector<Picture::Shown> Picture::shown() const {
  std::vector<Shown> result;
  for (const auto& [key, chunk] : chunks_) result.push_back({key, chunk.mesh.get(), chunk.mask});
  return result;
}

}  // namespace sgm_godot
