// SPDX-License-Identifier: MIT
// Radiance of a homogeneous slab in the forward scattering model: light that runs through optical
// depth tau of the slab is scattered forward a Poisson number of times with mean n = albedo tau and
// loses what those scatterings send backwards; the view ray sees it scattered once more.
//
// With chi_l the Legendre moments of the phase function, P(n, c) = sum (2 l + 1) / (4 pi) chi_l
// e^(-n (1 - chi_l)) P_l(c) has n + 1 scatterings in the mean, F(n) is its forward hemisphere, and
//   I(tau) = exp(-integral of (1 - albedo F(albedo tau')) dtau'),
//   L = integral over the view ray of e^-x I(tau(x)) albedo P(albedo tau(x), c) dx.
// Derived from [R04] 4.2 with Poisson counts; sums and integrals as they stand.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace welkin::reference {

struct ForwardSlab {
  double g;  // Henyey-Greenstein: chi_l = g^l
  double albedo;
  double thickness;  // optical, across the slab

  // 260 moments: 0.85^260 < 1e-18.
  static constexpr int MOMENTS = 260;

  double source(double n, double c) const {
    double sum = 0;
    double p = 1;
    double before = 0;
    for (int l = 0; l < MOMENTS; ++l) {
      const double chi = std::pow(g, l);
      sum += (2 * l + 1) * chi * std::exp(-n * (1 - chi)) * p;
      const double next = ((2 * l + 1) * c * p - l * before) / (l + 1);
      before = p;
      p = next;
    }
    return sum / (4 * std::numbers::pi);
  }

  // Integral of P_l over [0, 1] is (P_(l-1)(0) - P_(l+1)(0)) / (2 l + 1), so 0 for even l > 0.
  double forward(double n) const {
    double sum = 0.5;
    double low = 1;  // P_(l-1)(0)
    for (int l = 1; l < MOMENTS; l += 2) {
      const double high = -low * l / (l + 1);
      const double chi = std::pow(g, l);
      sum += 0.5 * chi * std::exp(-n * (1 - chi)) * (low - high);
      low = high;
    }
    return sum;
  }

  // View and light make angles with cosines viewMu, lightMu > 0 with the slab's normal; `opposite`:
  // the light stands behind the slab. c: cosine of the scattering angle. Simpson's rule in `count`
  // steps, on the light path's depth too.
  double radiance(double viewMu, double lightMu, bool opposite, double c, int count = 400) const {
    const double path = thickness / lightMu;
    const double h = path / (2 * count);
    std::vector<double> intensity{1.0};
    double lost = 0;
    const auto loss = [&](double tau) { return 1 - albedo * forward(albedo * tau); };
    for (int i = 0; i < 2 * count; ++i) {
      lost += h / 6 * (loss(i * h) + 4 * loss((i + 0.5) * h) + loss((i + 1) * h));
      intensity.push_back(std::exp(-lost));
    }
    double sum = 0;
    for (int i = 0; i <= 2 * count; ++i) {
      const double tau = i * h;
      const double z = opposite ? thickness - tau * lightMu : tau * lightMu;
      const double weight = i == 0 || i == 2 * count ? 1 : (i % 2 == 1 ? 4 : 2);
      sum += weight * std::exp(-z / viewMu) * intensity[static_cast<size_t>(i)] *
             source(albedo * tau, c);
    }
    return albedo * sum * h / 3 * lightMu / viewMu;
  }
};

}  // namespace welkin::reference
