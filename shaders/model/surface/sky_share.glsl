// SPDX-License-Identifier: MIT
// Where a slab lies in the table of diffuse light (src/tables/surface_ambient): of the source of
// light of all orders, the part that light from the lit face's side makes, less what diffusion says
// of it, which is linear across the slab. Equal light from both
// sides makes a source as bright as it is, whatever the slab.
const int SHARE_DEPTHS = 11;
const int SHARE_THICKNESSES = 12;
const int SHARE_VIEWS = 4;  // of each hemisphere

struct SharePlace {
  vec2 node;  // depth, thickness, from 0
  real view;  // in its hemisphere, from 0
  bool up;
  real diffuse;  // to be added to the table's value
};

SharePlace sharePlace(real thickness, real depth, real muView) {
  real t = clamp(thickness, real(1e-6), real(1e6));
  vec2 inside = canonicalInside(t, clamp(depth, real(0.0f), t));
  real within = clamp(inside.y, real(0.0f), inside.x);
  SharePlace place;
  place.node = vec2(canonicalDepth(within, inside.x) * real(SHARE_DEPTHS - 1),
                    canonicalThickness(inside.x) * real(SHARE_THICKNESSES - 1));
  place.view = canonicalCosine(abs(muView)) * real(SHARE_VIEWS - 1);
  place.up = muView < real(0.0f);
  place.diffuse = diffuseLeft(t, clamp(depth, real(0.0f), t));
  return place;
}
