// SPDX-License-Identifier: MIT
#include "support/vulkan_layer.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "support/fault_layer.hpp"

namespace welkin::test {
namespace {

constexpr LayerHooks HOOKS{FaultLayer::replace, FaultLayer::enter, FaultLayer::count};
constexpr LayerHooks NONE{};

SetLayerHooks setterOf(void* library) {
  return reinterpret_cast<SetLayerHooks>(dlsym(library, "welkinSetLayerHooks"));
}

}  // namespace

// The loader opens the same file, so that its hooks are these.
UnderFaultLayer::UnderFaultLayer()
    : library_(dlopen(WELKIN_LAYER_FOLDER "/libwelkin_fault_layer.so", RTLD_NOW)) {
  if (library_ == nullptr) {
    throw std::runtime_error(std::string("no layer: ") + dlerror());
  }
  setterOf(library_)(&HOOKS);
  setenv("VK_LAYER_PATH", WELKIN_LAYER_FOLDER, 1);
  setenv("VK_INSTANCE_LAYERS", "VK_LAYER_WELKIN_faults", 1);
}

UnderFaultLayer::~UnderFaultLayer() {
  unsetenv("VK_INSTANCE_LAYERS");
  unsetenv("VK_LAYER_PATH");
  setterOf(library_)(&NONE);
  dlclose(library_);
}

}  // namespace welkin::test
