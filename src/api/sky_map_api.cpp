// SPDX-License-Identifier: MIT
// wlkEvalSkyMap: radiance from all directions in an octahedral map.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "api/context.hpp"
#include "api/sky_map.hpp"
#include "api/sky_query.hpp"
#include "api/validate.hpp"

using namespace welkin;

WlkResult wlkEvalSkyMap(WlkContext context, const WlkSkyMapQuery* query, float* rgb,
                        uint64_t rgbSize) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const WlkSkyMapQuery q = copyStruct(query, WLK_STRUCT_SKY_MAP_QUERY);
    checkNoChain(query);
    for (const double x : q.position) {
      checkRange(q.sType, "position", x, -1e9, 1e9);
    }
    checkRange(q.sType, "size", q.size, 4, 1024);
    checkRange(q.sType, "maxOrder", q.maxOrder, ALL_ORDERS, FIRST_ORDER);
    checkPointer(rgb, "rgb");
    checkRoom(0, "rgbSize", rgbSize, uint64_t{12} * q.size * q.size);
    std::array<std::optional<SkyMap>, MAX_LIGHTS> maps;
    for (uint32_t l = 0; l < std::max(c.air.lightCount, 1U); ++l) {
      maps[l].emplace(c.air, planetFrameAt(c.air.planet, checkedPoint(q.position, "position")), l,
                      higherOrdersOf(c, airQueryOf(c.air), q.maxOrder));
    }
    const double halfWidth = 1.0 / q.size;
    for (uint32_t j = 0; j < q.size; ++j) {
      for (uint32_t i = 0; i < q.size; ++i) {
        const glm::dvec2 uv((2.0 * i + 1) * halfWidth - 1, (2.0 * j + 1) * halfWidth - 1);
        glm::dvec3 light(0);
        for (const std::optional<SkyMap>& map : maps) {
          light += map ? map->texel(uv, halfWidth) : glm::dvec3(0);
        }
        for (int k = 0; k < 3; ++k) {
          *rgb++ = static_cast<float>(
              std::min(light[k], static_cast<double>(std::numeric_limits<float>::max())));
        }
      }
    }
    return WLK_SUCCESS;
  });
}
