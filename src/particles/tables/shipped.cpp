// SPDX-License-Identifier: MIT
// The tables that welkin_tables wrote, in the library's constant data.
#include "particles/phase_table.hpp"

namespace welkin {
namespace {

namespace haze {
#include "particles/tables/haze.inc"
}
namespace droplet {
#include "particles/tables/droplet.inc"
}
namespace rain {
#include "particles/tables/rain.inc"
}
namespace ice_column {
#include "particles/tables/ice_column.inc"
}
namespace ice_plate {
#include "particles/tables/ice_plate.inc"
}
namespace snow {
#include "particles/tables/snow.inc"
}

}  // namespace

#define WELKIN_TABLE(name, features)                                                               \
  {                                                                                                \
#name, features, name::KNOT, name::AXIS,                                                       \
        name::RANGE[0], name::RANGE[1], name::CODE, name::ASYMMETRY, name::EFFICIENCY, name::DELTA \
  }

const PhaseTable HAZE_TABLE = WELKIN_TABLE(haze, Features::None);
const PhaseTable DROPLET_TABLE = WELKIN_TABLE(droplet, Features::Bows);
const PhaseTable RAIN_TABLE = WELKIN_TABLE(rain, Features::Bows);
const PhaseTable ICE_COLUMN_TABLE = WELKIN_TABLE(ice_column, Features::Halos);
const PhaseTable ICE_PLATE_TABLE = WELKIN_TABLE(ice_plate, Features::Halos);
const PhaseTable SNOW_TABLE = WELKIN_TABLE(snow, Features::None);

}  // namespace welkin
