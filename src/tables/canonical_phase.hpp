// SPDX-License-Identifier: MIT
// Phase function of a cloud for the canonical slab: droplets by Mie theory, their forward peak
// taken out ([B08] appendix A). 1/sr, integral over the sphere 1. No Vulkan. Not part of the
// library.
#pragma once

#include <cstddef>
#include <vector>

namespace welkin {

struct CanonicalPhase {
  std::vector<double> y;      // 1 - cos(angle), rising, 0 .. 2
  std::vector<double> value;  // linear in y between, without the peak
  // Part f of the energy that went with the peak: light of the peak goes on, so that an optical
  // depth of the canonical slab is (1 - f) of the cloud's.
  double removed = 0;
  double asymmetry = 0;  // mean cosine before
};

// [B08] Eq. 3 with r_e = 6 um and gamma = 2, at 550 nm; within 5 degrees P is at most P(5 degrees).
// The paper gives f as 0.5; it follows from P. 1 s.
CanonicalPhase canonicalPhase();

// chi_l, l < count, of the phase function without its peak.
std::vector<double> canonicalMoments(const CanonicalPhase& phase, size_t count);

}  // namespace welkin
