// SPDX-License-Identifier: MIT
// Nodes of a view's sky table: cosine of the azimuth from the light (+1 to -1), zenith angle above
// and below the horizon, dense towards it, and share of the ray's opacity.
const int SKY_AZIMUTHS = 16;
const int SKY_ABOVE = 20;
const int SKY_ABOVE_IN_TWILIGHT = 44;  // the edge of the planet's shadow is in the table
const int SKY_BELOW = 20;
const int SKY_ZENITHS = SKY_ABOVE_IN_TWILIGHT + SKY_BELOW;
const int SKY_SHARES = 6;
// The image of what fog scatters, see src/tables/fog_light.hpp: views across, azimuths down, and
// blocks of heights, one for each sun, in its depth.
const int FOG_SUNS = 21;
const int FOG_HEIGHTS = 12;
const int FOG_AZIMUTHS = 16;
const int FOG_VIEWS = 32;
// The image of the moments: their blocks of altitudes one below the other, then the ground's row.
const int MOMENT_SUNS = 48;
const int MOMENT_ALTITUDES = 32;
const int MOMENT_ROWS = 6 * MOMENT_ALTITUDES + 1;
