// SPDX-License-Identifier: MIT
// welkin_error_map OUT.csv: radiance of slabs by forward multiple scattering ([R04] 4.2), as
// printed and as corrected, beside the exact one, over kind of particle, optical thickness and
// angles in the plane of the sun. Per unit irradiance normal to the beam, 1/sr, at 550 nm, without
// absorption. Thickness does not count what goes straight on (rain, ice, snow). Under a minute.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <future>
#include <numbers>
#include <string>
#include <vector>

#include "common/api.hpp"
#include "common/error.hpp"
#include "reference/slab_model.hpp"
#include "reference/slab_solver.hpp"

namespace {

namespace rt = welkin::reference;

constexpr double PI = std::numbers::pi;
constexpr int MOMENTS = 1500;  // against 3000 or 4000: median 1e-5, at most 0.9 %
// Against 256 (20 um droplets) and 128 nodes (rain, ice): median 4e-5, 95 % of directions 2e-3, at
// most 1.1 %. 64 nodes: at most 1.6 %.
constexpr int NODES = 96;
constexpr int SLICES = 256;  // [R04] Figure 14
constexpr int MORE_SLICES = 1024;

struct Kind {
  const char* name;
  uint32_t particle;
  float diameter_um;
};
constexpr Kind KINDS[] = {{"hg", WLK_PARTICLE_HENYEY_GREENSTEIN, 0},
                          {"cloud", WLK_PARTICLE_CLOUD, 20},
                          {"fog", WLK_PARTICLE_FOG, 5},
                          {"haze", WLK_PARTICLE_HAZE, 0.6F},
                          {"ice-column", WLK_PARTICLE_ICE_COLUMN, 0},
                          {"snow", WLK_PARTICLE_SNOW, 0},
                          {"rain", WLK_PARTICLE_RAIN, 0}};
constexpr double THICKNESSES[] = {0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100};
// Zenith angles, degrees. Views hold those of the suns, and so the beam and the glory.
constexpr int SUNS[] = {0, 30, 60, 80};
constexpr int VIEWS[] = {-80, -60, -30, -15, 0, 15, 30, 60, 80};
constexpr double G = 0.85;

// Angles dense around both ends, where peaks and glories are.
std::vector<double> phaseAngles() {
  std::vector<double> angles{0.0};
  while (angles.back() < PI) {
    const double end = std::min(angles.back(), PI - angles.back());
    angles.push_back(angles.back() + std::clamp(0.01 * end, 1e-5, 5e-4));
  }
  angles.back() = PI;
  return angles;
}

// The library's curve for green; what goes straight on is not in it.
rt::SlabPhase phaseOf(WlkContext context, const Kind& kind) {
  if (kind.particle == WLK_PARTICLE_HENYEY_GREENSTEIN) {
    return rt::henyeyGreensteinSlabPhase(G);
  }
  static const std::vector<double> angles = phaseAngles();
  auto info = host::make<WlkMediumInfo>();
  info.particle = kind.particle;
  info.diameter_um = kind.diameter_um;
  WlkMedium medium{};
  host::check(wlkCreateMedium(context, &info, &medium), "wlkCreateMedium");
  auto query = host::make<WlkPhaseQuery>();
  query.medium = medium;
  query.count = static_cast<uint32_t>(angles.size());
  query.scatteringAngle = angles.data();
  std::vector<double> rgb(angles.size() * 3);
  host::check(wlkEvalPhase(context, &query, rgb.data()), "wlkEvalPhase");
  std::vector<double> green;
  for (size_t i = 0; i < angles.size(); ++i) {
    green.push_back(rgb[3 * i + 1]);
  }
  return rt::tabulatedSlabPhase(angles, green, MOMENTS);
}

struct Direction {
  int view_deg;  // from the vertical; < 0: the light comes back to the side that the sun is on
  bool reflected;
  rt::SlabView view;
};

std::vector<Direction> directionsFor(int sun_deg) {
  std::vector<Direction> directions;
  for (const bool reflected : {true, false}) {
    for (const int view : VIEWS) {
      if (view < 0 && sun_deg == 0) {
        continue;  // the same as view > 0
      }
      const double mu = std::cos(view * PI / 180);
      directions.push_back({view, reflected, {reflected ? mu : -mu, view < 0 ? PI : 0}});
    }
  }
  return directions;
}

double separation(double mu0, const rt::SlabView& view) {
  const double sines = std::sqrt((1 - mu0 * mu0) * (1 - view.mu * view.mu));
  return std::max(1 + view.mu * mu0 - sines * std::cos(view.phi), 0.0);
}

std::string rowsOf(const Kind& kind, const rt::SlabPhase& phase) {
  using Attenuation = rt::SlabModel::Attenuation;
  std::string rows;
  const rt::SlabSolver solver(phase, 1, NODES);
  const rt::SlabModel model(phase, 1, 100 / std::cos(80 * PI / 180) + 1);
  for (const int sun : SUNS) {
    const double mu0 = std::cos(sun * PI / 180);
    const std::vector<Direction> directions = directionsFor(sun);
    std::vector<rt::SlabView> views;
    std::vector<rt::SlabModel::Angle> angles;
    for (const Direction& one : directions) {
      views.push_back(one.view);
      angles.push_back(model.prepare(separation(mu0, one.view)));
    }
    for (const double tau : THICKNESSES) {
      const std::vector<rt::SlabRadiance> truth = solver.radiance(tau, mu0, views);
      for (size_t i = 0; i < views.size(); ++i) {
        const double mu = views[i].mu;
        const auto printed = [&](Attenuation attenuation, int slices) {
          return model.printed(tau, mu0, mu, angles[i], attenuation, slices);
        };
        std::array<char, 200> row{};
        std::snprintf(row.data(), row.size(), "%s,%g,%d,%d,%s,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g\n",
                      kind.name, tau, sun, directions[i].view_deg,
                      directions[i].reflected ? "reflected" : "transmitted", truth[i].total,
                      truth[i].single, printed(Attenuation::EQ_24, SLICES),
                      printed(Attenuation::EQ_25, SLICES), printed(Attenuation::EQ_25, MORE_SLICES),
                      model.corrected(tau, mu0, mu, angles[i]));
        rows += row.data();
      }
    }
  }
  return rows;
}

int run(const char* path) {
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) {
    std::fprintf(stderr, "%s: cannot write\n", path);
    return 1;
  }
  std::fprintf(file,
               "type,tau,sun_deg,view_deg,side,truth,single,printed24,"
               "printed25,printed25_1024,corrected\n");
  const host::ContextPtr context = host::makeCpuContext();
  std::vector<std::future<std::string>> parts;
  for (const Kind& kind : KINDS) {
    parts.push_back(
        std::async(std::launch::async, rowsOf, std::cref(kind), phaseOf(context.get(), kind)));
  }
  for (std::future<std::string>& part : parts) {
    std::fputs(part.get().c_str(), file);
  }
  return std::fclose(file) == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: welkin_error_map OUT.csv\n");
    return 2;
  }
  try {
    return run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
