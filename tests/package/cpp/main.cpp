// SPDX-License-Identifier: MIT
// The same over welkin.hpp, with containers and exceptions of the program's own beside the
// library's.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>
#include <welkin/welkin.hpp>

static int failures = 0;

static void require(bool condition, const char* what) {
  if (!condition) {
    std::fprintf(stderr, "not true: %s\n", what);
    ++failures;
  }
}

static double henyeyGreenstein(double g, double angle) {
  const double pi = std::acos(-1.0);
  return (1.0 - g * g) / (4.0 * pi * std::pow(1.0 + g * g - 2.0 * g * std::cos(angle), 1.5));
}

static void phaseFunction(WlkContext context, WlkMedium medium, double g) {
  const std::vector<double> angles = {0.0, 0.5, 1.0, 2.0, 3.0};
  std::vector<double> phase(3 * angles.size());
  WlkPhaseQuery query = welkin::make<WlkPhaseQuery>();
  query.medium = medium;
  query.count = static_cast<std::uint32_t>(angles.size());
  query.scatteringAngle = angles.data();
  welkin::check(wlkEvalPhase(context, &query, phase.data()));
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double expected = henyeyGreenstein(g, angles[i]);
    require(std::fabs(phase[3 * i] / expected - 1.0) < 1e-6, "the phase function is right");
  }
}

static void errors(WlkContext context) {
  WlkMediumInfo info = welkin::make<WlkMediumInfo>();
  info.diameter_um = -1.0f;
  std::string field;
  try {
    const welkin::Medium medium(context, info);
  } catch (const welkin::Error& error) {
    field = error.info().field;
  }
  require(field == "diameter_um", "the exception names the field");
}

int main() {
  try {
    const welkin::Context context(welkin::make<WlkContextInfo>());
    WlkMediumInfo info = welkin::make<WlkMediumInfo>();
    info.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
    info.asymmetry = 0.5f;
    const welkin::Medium medium(context, info);
    require(wlkGetVersion() == WLK_API_VERSION, "header and library are of one version");
    phaseFunction(context, medium, 0.5);
    errors(context);
  } catch (const std::exception& error) {
    require(false, error.what());
  }
  if (failures == 0) {
    std::puts("welkin answers");
  }
  return failures != 0;
}
