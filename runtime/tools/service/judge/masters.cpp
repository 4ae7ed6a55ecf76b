#include "tools/service/judge/masters.h"

#include <new>
#include <utility>

namespace sgm::service {
namespace {

constexpr std::chrono::seconds kFresh{5};

MastersAnswer answerOf(Inspection said) {
  MastersAnswer answer;
  try {
    answer.json = std::make_shared<const std::string>(std::move(said.json));
    answer.status = said.status;
  } catch (const std::bad_alloc&) {
    // There is no memory for the JSON: keep the default status, 503.
  }
  return answer;
}

}  // namespace

void Masters::read(Told told) {
  MastersAnswer fresh;
  {
    const std::lock_guard lock(mutex_);
    if (last_.status != 200 || std::chrono::steady_clock::now() - when_ >= kFresh) {
      waiting_.push_back(std::move(told));
      if (waiting_.size() > 1) return;
    } else {
      fresh = last_;
    }
  }
  if (fresh.json != nullptr) return told(fresh);
  try {
    inspector_.readMasters([this](Inspection said) { tell(answerOf(std::move(said))); });
  } catch (const std::bad_alloc&) {
    tell({});
  }
}

void Masters::tell(MastersAnswer said) {
  std::vector<Told> waiting;
  {
    const std::lock_guard lock(mutex_);
    waiting.swap(waiting_);
    last_ = said;
    when_ = std::chrono::steady_clock::now();
  }
  for (const Told& each : waiting) each(said);
}

void Masters::keep(const MastersAnswer& said) {
  if (said.status != 200) return;
  const std::lock_guard lock(mutex_);
  last_ = said;
  when_ = std::chrono::steady_clock::now();
}

void Masters::write(std::string json, Told told) {
  inspector_.writeMasters(std::move(json), [this, told = std::move(told)](Inspection inspection) {
    const MastersAnswer said = answerOf(std::move(inspection));
    keep(said);
    told(said);
  });
}

MastersAnswer Masters::last() const {
  const std::lock_guard lock(mutex_);
  return last_;
}

}  // namespace sgm::service
