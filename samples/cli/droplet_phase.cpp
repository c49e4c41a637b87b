// SPDX-License-Identifier: MIT
#include "cli/droplet_phase.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "reference/mie_reference.hpp"

namespace cli {
namespace {

namespace truth = welkin::reference;

// Resonances are spikes in size, which the nodes meet by chance: the error falls like 1 / nodes.
constexpr double NODES_PER_SPREAD = 512.0;
// Work of one thread at a time; sums of chunks are added in order.
constexpr size_t CHUNKS = 32;
// Angles whose recurrences run side by side.
constexpr size_t LANES = 8;

// Water relative to air: IAPWS R9-97, Release on the Refractive Index of Ordinary Water Substance
// as a Function of Wavelength, Temperature and Pressure, Eq. 1 with table 1, at 10 degrees Celsius
// and 999.70 kg/m^3; over 1.000277 of air.
double waterIndexInAir(double wavelength_um) {
  const double density = 0.99970;
  const double temperature = 283.15 / 273.15;
  const double l2 = std::pow(wavelength_um / 0.589, 2);
  const double r =
      density * (0.244257733 + 9.74634476e-3 * density - 3.73234996e-3 * temperature +
                 2.68678472e-4 * l2 * temperature + 1.58920570e-3 / l2 +
                 2.45934259e-3 / (l2 - 0.2292020 * 0.2292020) +
                 0.900704920 / (l2 - 5.432937 * 5.432937) - 1.66626219e-2 * density * density);
  return std::sqrt((1.0 + 2.0 * r) / (1.0 - r)) / 1.000277;
}

// In steps of 2 % of the angle to the nearer end, from 2e-5 (forward peaks of the largest droplets
// are 1e-4 wide) to 4e-3 rad; the averaged bows and glories are wider.
std::vector<double> dropletAngles() {
  std::vector<double> angles{0.0};
  while (angles.back() < std::numbers::pi) {
    const double end = std::min(angles.back(), std::numbers::pi - angles.back());
    angles.push_back(angles.back() + std::clamp(0.02 * end, 2e-5, 4e-3));
  }
  angles.back() = std::numbers::pi;
  return angles;
}

// As MieTruth::amplitudes, in double: adds weight times (|S1|^2 + |S2|^2) / 2 to `sums`. The
// recurrence in the angle loses a few digits of double; the coefficients are those in long double.
void addIntensities(const reference::MieTruth& sphere, double weight,
                    const std::vector<double>& cosines, std::vector<double>& sums) {
  const size_t count = sphere.a.size();
  std::vector<std::array<double, 4>> terms(count);
  for (size_t i = 1; i < count; ++i) {
    const auto n = static_cast<reference::Real>(i);
    const reference::Real factor = (2 * n + 1) / (n * (n + 1));
    terms[i] = {static_cast<double>(factor * sphere.a[i].real()),
                static_cast<double>(factor * sphere.a[i].imag()),
                static_cast<double>(factor * sphere.b[i].real()),
                static_cast<double>(factor * sphere.b[i].imag())};
  }
  for (size_t first = 0; first < cosines.size(); first += LANES) {
    double mu[LANES] = {};
    double pi[LANES];
    double before[LANES] = {};
    double s1Re[LANES] = {};
    double s1Im[LANES] = {};
    double s2Re[LANES] = {};
    double s2Im[LANES] = {};
    const size_t lanes = std::min(LANES, cosines.size() - first);
    std::copy_n(cosines.begin() + static_cast<std::ptrdiff_t>(first), lanes, mu);
    std::fill(std::begin(pi), std::end(pi), 1.0);
    for (size_t i = 1; i < count; ++i) {
      const double n = static_cast<double>(i);
      const double up = (2.0 * n + 1.0) / n;
      const double down = (n + 1.0) / n;
      const std::array<double, 4> t = terms[i];
      for (size_t k = 0; k < LANES; ++k) {
        const double tau = n * mu[k] * pi[k] - (n + 1.0) * before[k];
        s1Re[k] += t[0] * pi[k] + t[2] * tau;
        s1Im[k] += t[1] * pi[k] + t[3] * tau;
        s2Re[k] += t[0] * tau + t[2] * pi[k];
        s2Im[k] += t[1] * tau + t[3] * pi[k];
        const double next = up * mu[k] * pi[k] - down * before[k];
        before[k] = pi[k];
        pi[k] = next;
      }
    }
    for (size_t k = 0; k < lanes; ++k) {
      sums[first + k] +=
          0.5 * weight *
          (s1Re[k] * s1Re[k] + s1Im[k] * s1Im[k] + s2Re[k] * s2Re[k] + s2Im[k] * s2Im[k]);
    }
  }
}

struct SizeNode {
  double x;       // size parameter
  double weight;  // number
};

// Trapezoidal rule in ln(diameter). Light counts with the diameter's square (below) to fourth
// (above, the forward peak) power, which moves a normal distribution by that many spread^2; 4.5
// and 5 standard deviations beyond hold all but 4e-6.
std::vector<SizeNode> sizeNodes(const Droplets& droplets, double wavelength_um) {
  const double s = droplets.spread;
  const double step = s / NODES_PER_SPREAD;
  const double top = 4.0 * s * s + 5.0 * s;
  std::vector<SizeNode> nodes;
  for (double t = 2.0 * s * s - 4.5 * s; t < top; t += step) {
    nodes.push_back({std::numbers::pi * droplets.diameter_um * std::exp(t) / wavelength_um,
                     std::exp(-0.5 * (t / s) * (t / s))});
  }
  return nodes;
}

std::vector<double> averageIntensity(const Droplets& droplets, double wavelength_um,
                                     const std::vector<double>& cosines, unsigned threads) {
  const double index = waterIndexInAir(wavelength_um);
  const std::vector<SizeNode> nodes = sizeNodes(droplets, wavelength_um);
  std::vector<std::vector<double>> sums(CHUNKS, std::vector<double>(cosines.size()));
  std::atomic<size_t> next{0};
  const auto work = [&] {
    for (size_t chunk = next++; chunk < CHUNKS; chunk = next++) {
      for (size_t i = chunk; i < nodes.size(); i += CHUNKS) {
        const reference::MieTruth sphere(reference::Real{nodes[i].x}, reference::Real{index});
        addIntensities(sphere, nodes[i].weight, cosines, sums[chunk]);
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < threads; ++i) {
      helpers.emplace_back(work);
    }
    work();
  }
  for (size_t chunk = 1; chunk < CHUNKS; ++chunk) {
    for (size_t i = 0; i < cosines.size(); ++i) {
      sums[0][i] += sums[chunk][i];
    }
  }
  return std::move(sums[0]);
}

}  // namespace

truth::PhaseFunction dropletPhase(const Droplets& droplets, unsigned threads) {
  const std::vector<double> angles = dropletAngles();
  std::vector<double> cosines;
  for (const double angle : angles) {
    cosines.push_back(std::cos(angle));
  }
  std::vector<truth::Rgb> values(angles.size());
  const unsigned wanted = threads > 0 ? threads : std::thread::hardware_concurrency();
  std::vector<double> one;
  for (size_t c = 0; c < 3; ++c) {
    if (c == 0 || droplets.wavelength_um[c] != droplets.wavelength_um[c - 1]) {
      one = averageIntensity(droplets, droplets.wavelength_um[c], cosines, std::max(wanted, 1u));
    }
    for (size_t i = 0; i < angles.size(); ++i) {
      values[i][c] = one[i];
    }
  }
  return truth::PhaseFunction::table(angles, values);
}

}  // namespace cli
