// SPDX-License-Identifier: MIT
// Light that came to tau' in the beam, e^(-tau' / mu0), displaced by tau' tan0 along x, turned by
// P_m(mu) and went on by u: z = tau' tan0 + u sin e^(i phi), tau' = tau - u mu, and e^-u remains.
#include "tables/slab_first.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace welkin {
namespace {

constexpr double INV_4PI = 0.25 * std::numbers::inv_pi;

// Integrals over u of e^(-u - tau' / mu0) times 1, tau', tau'^2, u, tau' u, u^2.
enum { ONE, D, DD, U, DU, UU, WEIGHTS };

void beamIntegrals(double tau, double thickness, double mu, double mu0, bool up,
                   std::array<double, WEIGHTS>& g) {
  const double length = (up ? thickness - tau : tau) / mu;
  // At the far end of the way back the beam has tau -+ length mu: 0, or the thickness.
  const double slope = (up ? mu : -mu);
  // e^(-u - (tau + slope u) / mu0) = e^(-a u - b (length - u)) with the exponents of both ends.
  const double near = tau / mu0;                             // at u = 0
  const double far = length + (up ? thickness : 0.0) / mu0;  // at u = length
  const double least = std::min(near, far);
  const double scale = std::exp(-least);
  const double a = length > 0 ? (far - least) / length : 0;
  const double b = length > 0 ? (near - least) / length : 0;
  const std::array<double, 3> moment = twoEndedMoments(a, b, length);
  const double m0 = scale * moment[0];
  const double m1 = scale * moment[1];
  const double m2 = scale * moment[2];
  g = {m0, tau * m0 + slope * m1, tau * tau * m0 + 2 * tau * slope * m1 + slope * slope * m2,
       m1, tau * m1 + slope * m2, m2};
}

}  // namespace

std::array<double, 3> twoEndedMoments(double a, double b, double length) {
  const double least = std::min(a, b);
  const double scale = length * std::exp(-least * length);
  const std::array<double, 5> phi = decayMoments(std::abs(a - b) * length);
  std::array<double, 3> result = {phi[0], phi[1], phi[2]};
  if (a < b) {  // the integrand falls towards u = 0: count from the other end
    result = {phi[0], phi[0] - phi[1], phi[0] - 2 * phi[1] + phi[2]};
  }
  double power = scale;
  for (double& value : result) {
    value *= power;
    power *= length;
  }
  return result;
}

SlabMoments firstOrder(const SlabMedium& medium, std::span<const double, SLAB_LANES> suns) {
  const auto& chi = medium.moments();
  const SlabDirections& nodes = medium.nodes();
  const size_t count = nodes.mu.size();
  const size_t depths = medium.depth().size();
  const int modes = static_cast<int>(chi.size()) - 1;
  SlabMoments result = medium.zeros(modes);
  std::vector<std::array<double, WEIGHTS>> g(2 * count * depths * SLAB_LANES);
  for (size_t ray = 0, i = 0; ray < 2 * count; ++ray) {
    for (const double tau : medium.depth()) {
      for (size_t lane = 0; lane < SLAB_LANES; ++lane, ++i) {
        beamIntegrals(tau, medium.thickness(), nodes.mu[ray % count], suns[lane], ray >= count,
                      g[i]);
      }
    }
  }
  // P_m at each direction for each sun; [m + 1] so that m - 1 = -1 and m + 1 exist.
  std::vector<double> phase(static_cast<size_t>(modes + 3) * 2 * count * SLAB_LANES);
  const auto turned = [&](int m, size_t ray, size_t lane) -> double& {
    return phase[(static_cast<size_t>(std::abs(m)) * 2 * count + ray) * SLAB_LANES + lane];
  };
  for (int m = 0; m <= modes; ++m) {
    std::vector<double> sun(chi.size() - static_cast<size_t>(m));
    for (size_t lane = 0; lane < SLAB_LANES; ++lane) {
      slabLegendre(m, suns[lane], sun);
      for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < sun.size(); ++k) {
          const size_t l = k + static_cast<size_t>(m);
          const double term = INV_4PI * static_cast<double>(2 * l + 1) * chi[l] * sun[k] *
                              nodes.legendre[static_cast<size_t>(m)][k * count + i];
          turned(m, i, lane) += term;
          turned(m, count + i, lane) += k % 2 == 0 ? term : -term;
        }
      }
    }
  }
  SlabRays rays;
  rays.light.resize(2 * count * depths * SLAB_LANES);
  const auto fill = [&](SlabField field, int m) {
    for (size_t ray = 0, i = 0; ray < 2 * count; ++ray) {
      const double mu = nodes.mu[ray % count];
      const double sine = std::sqrt((1 - mu) * (1 + mu));
      for (size_t k = 0; k < depths; ++k) {
        for (size_t lane = 0; lane < SLAB_LANES; ++lane, ++i) {
          const double mu0 = suns[lane];
          const double tangent = std::sqrt((1 - mu0) * (1 + mu0)) / mu0;
          const double here = turned(m, ray, lane);
          const double below = turned(m - 1, ray, lane);
          const double above = turned(m + 1, ray, lane);
          rays.light[i] = field == SlabField::Intensity ? here * g[i][ONE]
                          : field == SlabField::Shift
                              ? here * tangent * g[i][D] + below * sine * g[i][U]
                              : here * (tangent * tangent * g[i][DD] + sine * sine * g[i][UU]) +
                                    (below + above) * tangent * sine * g[i][DU];
        }
      }
    }
    medium.project({field, m, &rays, {}}, result);
  };
  for (int m = 0; m <= modes; ++m) {
    fill(SlabField::Intensity, m);
    fill(SlabField::Spread, m);
    fill(SlabField::Shift, m);
    if (m > 0) {
      fill(SlabField::Shift, -m);
    }
  }
  return result;
}

}  // namespace welkin
