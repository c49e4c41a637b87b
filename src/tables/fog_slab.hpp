// SPDX-License-Identifier: MIT
// Light scattered at least once in plane-parallel layers of air and fog over a Lambertian ground,
// one colour: discrete ordinates with 16 streams, azimuth by azimuth. The equations of all cells
// are solved at once, without iterating on orders, and their factors serve every sun: thick fog
// that absorbs nothing costs what thin fog does. No Vulkan.
//
// Fog's forward peak of the 16th Legendre moment counts as unscattered (delta-M, Wiscombe 1977):
// depths and moments given here are without it. Directions are those of travel, by their cosine
// with the up; azimuths are against the beam's direction of travel.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace welkin {

constexpr size_t FOG_TERMS = 16;  // Legendre terms 0 to 15
using FogTermsOf = std::array<double, FOG_TERMS>;

// One layer. Depth: vertical optical depth; shares: scattering by air and by fog over extinction.
struct FogCell {
  double depth = 0;
  double air = 0;
  double fog = 0;
};

// A beam in the layers: irradiance normal to it, mean over each cell, and at the ground.
struct FogBeam {
  double sunMu = 1;  // cosine of the zenith angle, > 0
  std::vector<double> irradiance;
  double atGround = 0;
};

// Expansion of the mean radiance of a cell in P_l^m of the direction of travel: what a phase
// function of 16 terms needs for the source of the next scattering.
class FogField {
 public:
  // l >= m, normalised: integral of radiance times P_l^m (of mean square 1 / (2 l + 1)) over 4 pi.
  double& at(size_t l, size_t m) { return terms_[l * FOG_TERMS + m]; }
  double at(size_t l, size_t m) const { return terms_[l * FOG_TERMS + m]; }

 private:
  std::array<double, FOG_TERMS * FOG_TERMS> terms_{};
};

// [beam][cell]
using FogFields = std::vector<std::vector<FogField>>;

class FogSlab {
 public:
  // Memory that azimuths are solved in, one after the other; for so many cells and beams.
  class Work {
   public:
    Work(size_t cells, size_t beams);
    ~Work();
    Work(Work&&) noexcept;
    Work& operator=(Work&&) noexcept;

   private:
    friend class FogSlab;
    struct Edge;
    std::vector<Edge> edges_;
    std::vector<double> radiance_;  // [edge][stream][beam]
  };

  // Cells from the top down; `fog`: its Legendre moments 0 to 15 without the peak.
  FogSlab(std::vector<FogCell> cells, const FogTermsOf& fog, double groundAlbedo);

  // Adds the part of azimuth m, 0 to 15, to the fields, which are 0 before the first. Allocates
  // nothing.
  void addMode(size_t m, const std::vector<FogBeam>& beams, Work& work, FogFields& fields) const;
  // All of them.
  FogFields solve(const std::vector<FogBeam>& beams) const;

 private:
  class Mode;
  std::vector<FogCell> cells_;
  FogTermsOf fog_;
  double groundAlbedo_;
};

// Normalised associated Legendre functions of a cosine, [l - m] for l = m to 15: mean square over
// -1 to 1 is 1 / (2 l + 1).
FogTermsOf legendreOf(size_t m, double mu);

}  // namespace welkin
