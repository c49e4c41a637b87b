// SPDX-License-Identifier: MIT
// Light inside volumes that several views show: kept once for all that ask for the same numbers,
// and as long as one of them or a frame in flight does. Not thread-safe.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

namespace welkin {

// Of which volume, in which grid; `kind`: what else tells two of them apart.
struct LightShape {
  uint32_t volume = 0;  // PlannedVolume::index
  uint32_t cells = 0;
  uint32_t kind = 0;

  bool operator==(const LightShape&) const = default;
};

template <typename Light>
class SharedLights {
 public:
  // What is kept of that shape, or what `make` makes.
  template <typename Make>
  std::shared_ptr<Light> of(const LightShape& shape, Make make) {
    std::erase_if(known_, [](const Known& one) { return one.light.expired(); });
    for (const Known& one : known_) {
      if (one.shape == shape) {
        return one.light.lock();
      }
    }
    known_.reserve(known_.size() + 1);
    auto made = std::make_shared<Light>(make());
    known_.push_back({shape, made});
    return made;
  }

 private:
  struct Known {
    LightShape shape;
    std::weak_ptr<Light> light;
  };
  std::vector<Known> known_;
};

}  // namespace welkin
