// SPDX-License-Identifier: MIT
// The slab that stands for a surface cloud around a point ([B08] 6.1, Fig. 7): coordinates of the
// canonical transport from what light maps hold. Depths are optical, along the light; directions
// are unit vectors.

struct TangentSlab {
  real thickness;  // across the slab
  real depth;      // of the point below the lit face, [0, thickness]
  real muLight;    // [CANONICAL_COSINE, 1]
  real muView;     // of the light's way to the eye, > 0 deeper into the slab, [-1, 1]
  real phi;        // azimuth of that way against the light's, [0, pi]
};

// Below this product of sines the azimuth is that of no direction, and stays 0.
const real SLAB_AZIMUTH_LEAST = real(1e-9);

// Angle in [0, pi] with this cosine and this sine >= 0, any common factor. No acos, which GPUs know
// to 1e-4.
real slabAngle(real cosine, real sine) {
  return sine > SLAB_AZIMUTH_LEAST || abs(cosine) > SLAB_AZIMUTH_LEAST ? atan(sine, cosine)
                                                                       : real(0.0f);
}

// `through`: depth of the cloud along the light, `depth`: of the point; `normal` points out of the
// lit face, all three filtered over the collector. Clamped: rounding and silhouettes give depths
// outside of the cloud and faces that turn away from the light.
TangentSlab tangentSlab(real through, real depth, vec3 normal, vec3 toLight, vec3 toEye) {
  TangentSlab slab;
  real muLight = dot(normal, toLight);
  slab.muLight = clamp(muLight, CANONICAL_COSINE, real(1.0f));
  slab.thickness = max(through, real(0.0f)) * slab.muLight;
  slab.depth = clamp(depth * slab.muLight, real(0.0f), slab.thickness);
  slab.muView = clamp(-dot(normal, toEye), real(-1.0f), real(1.0f));
  // Horizontal parts of the light's travel and of the way to the eye.
  vec3 light = normal * muLight - toLight;
  vec3 view = toEye + normal * slab.muView;
  vec3 turn = cross(light, view);
  slab.phi = slabAngle(dot(light, view), sqrt(dot(turn, turn)));
  return slab;
}
