#pragma once
// Makes Vulkan calls fail on request: replaces the entries of the function tables by functions that count calls and may
// return an error.
//
// Vulkan functions have no user data, so the state is static: only one Faults may exist at a time.

#include <map>
#include <mutex>
#include <string>

#include "backend/vulkan/device.h"

namespace sgm::vulkan {

class Faults {
 public:
  Faults() { state() = State(); }

  /// Makes the nth call of a function from now on, counted from 1, return `result` and do nothing else.
  void arm(const std::string& function, unsigned nth, VkResult result) {
    const std::scoped_lock lock(mutex());
    state().function = function;
    state().nth = nth;
    state().result = result;
    state().counts.clear();
  }
  void disarm() { arm({}, 0, VK_SUCCESS); }
  bool struck() const { return state().function.empty() || state().counts[state().function] >= state().nth; }
  /// Number of calls since the last arm() of each function that returns a VkResult.
  std::map<std::string, unsigned> counts() const { return state().counts; }

  static void wrap(DeviceTable& table) {
    real<DeviceTable>() = table;
#define SGM_WRAP(name) Wrapper<&DeviceTable::name>::into(table, #name);
    SGM_VK_DEVICE(SGM_WRAP)
#undef SGM_WRAP
#define SGM_WRAP(name) \
  if (table.name) Wrapper<&DeviceTable::name>::into(table, #name);
    SGM_VK_DEVICE_EXTENSIONS(SGM_WRAP)
#undef SGM_WRAP
  }
  static void wrap(InstanceTable& table) {
    real<InstanceTable>() = table;
#define SGM_WRAP(name) Wrapper<&InstanceTable::name>::into(table, #name);
    SGM_VK_INSTANCE(SGM_WRAP)
#undef SGM_WRAP
  }

 private:
  struct State {
    std::string function;
    unsigned nth = 0;
    VkResult result = VK_SUCCESS;
    std::map<std::string, unsigned> counts;
  };
  static State& state() {
    static State one;
    return one;
  }
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  template <class Table>
  static Table& real() {
    static Table one;
    return one;
  }
  static VkResult refusal(const char* function) {
    const std::scoped_lock lock(mutex());
    const unsigned count = ++state().counts[function];
    return function == state().function && count == state().nth ? state().result : VK_SUCCESS;
  }

  template <auto kMember>
  struct Wrapper;
  template <class Table, class Return, class... Arguments, Return (*Table::*kMember)(Arguments...)>
  struct Wrapper<kMember> {
    static inline const char* name = "";
    static void into(Table& table, const char* function) {
      name = function;
      if constexpr (std::is_same_v<Return, VkResult>) table.*kMember = call;
    }
    static Return call(Arguments... arguments) {
      if (const VkResult refused = refusal(name); refused != VK_SUCCESS) return refused;
      return (real<Table>().*kMember)(arguments...);
    }
  };
};

}  // namespace sgm::vulkan
