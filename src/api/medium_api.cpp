// SPDX-License-Identifier: MIT
// Media: creation, optics, phase functions and samples.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "api/context.hpp"
#include "api/validate.hpp"
#include "particles/medium.hpp"
#include "particles/mie_average.hpp"
#include "tables/scattering_orders.hpp"
#include "welkin/welkin.h"

using namespace welkin;

namespace {

constexpr uint32_t MAX_USER_ROWS = 65536;
constexpr double ANGLE_SLACK = 1e-12;  // rad, of a rounded pi

// The value, or the type's default for 0; fails outside of the type's range.
double ranged(const WlkMediumInfo& m, const char* field, float value, const ParticleRange& range,
              const char* type) {
  if (value == 0) {
    return range.initial;
  }
  if (!(value >= static_cast<float>(range.low) && value <= static_cast<float>(range.high))) {
    if (range.high == 0) {
      fail(WLK_ERROR_INVALID_ARGUMENT, m.sType, field, "WlkMediumInfo::%s is %g, but %s has none",
           field, static_cast<double>(value), type);
    }
    fail(WLK_ERROR_INVALID_ARGUMENT, m.sType, field,
         "WlkMediumInfo::%s is %g, expected 0 or [%g, %g] for %s", field,
         static_cast<double>(value), range.low, range.high, type);
  }
  // 0.25 and its like, as doubles.
  return value == static_cast<float>(range.initial) ? range.initial : static_cast<double>(value);
}

void checkUserTable(const WlkMediumInfo& m) {
  checkRange(m.sType, "userCount", m.userCount, 2, MAX_USER_ROWS);
  checkPointer(m.userAngle, "userAngle");
  checkPointer(m.userPhase, "userPhase");
  std::array<double, RGB> most{};
  for (uint32_t i = 0; i < m.userCount; ++i) {
    const double angle = m.userAngle[i];
    const bool rises = i == 0 ? std::abs(angle) <= ANGLE_SLACK : angle > m.userAngle[i - 1];
    const bool ends =
        i + 1 < m.userCount || std::abs(angle - std::numbers::pi) <= 1e-9 * std::numbers::pi;
    if (!rises || !ends || !std::isfinite(angle)) {
      fail(WLK_ERROR_INVALID_ARGUMENT, m.sType, "userAngle",
           "WlkMediumInfo::userAngle[%u] is %.17g; angles rise from 0 to pi", i, angle);
    }
    for (size_t c = 0; c < RGB; ++c) {
      const double p = m.userPhase[i * RGB + c];
      if (!(p >= 0 && p <= 1e30)) {
        fail(WLK_ERROR_INVALID_ARGUMENT, m.sType, "userPhase",
             "WlkMediumInfo::userPhase of angle %u is %g, expected [0, 1e30]", i, p);
      }
      most[c] = std::max(most[c], p);
    }
  }
  for (const double p : most) {
    if (!(p > 0)) {
      fail(WLK_ERROR_INVALID_ARGUMENT, m.sType, "userPhase",
           "WlkMediumInfo::userPhase is 0 at every angle");
    }
  }
}

ParticleParams checkedParams(const WlkMediumInfo& m, ParticleType type) {
  const ParticleKind& kind = particleKind(type);
  ParticleParams params;
  checkRange(m.sType, "phaseModel", m.phaseModel, WLK_PHASE_DEFAULT, WLK_PHASE_TABLE);
  if ((m.phaseModel == WLK_PHASE_ANALYTIC && !kind.hasAnalytic) ||
      (m.phaseModel == WLK_PHASE_TABLE && !kind.hasTable)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, m.sType, "phaseModel",
         "WlkMediumInfo::phaseModel %u does not exist for %s", m.phaseModel, kind.name);
  }
  params.analytic = m.phaseModel == WLK_PHASE_ANALYTIC || !kind.hasTable;
  params.diameter_um = ranged(m, "diameter_um", m.diameter_um, kind.diameter_um, kind.name);
  params.spread = ranged(m, "spread", m.spread, kind.spread, kind.name);
  params.roughness = ranged(m, "roughness", m.roughness, kind.roughness, kind.name);
  if (m.phaseModel == WLK_PHASE_ANALYTIC && params.spread != kind.spread.initial) {
    fail(WLK_ERROR_INVALID_ARGUMENT, m.sType, "spread",
         "WlkMediumInfo::spread is %g, but the closed form has %g", params.spread,
         kind.spread.initial);
  }
  if (type == ParticleType::HenyeyGreenstein) {
    checkRange(m.sType, "asymmetry", m.asymmetry, -0.999f, 0.999f);
    params.asymmetry = static_cast<double>(m.asymmetry);
  }
  if (m.wavelength_um != 0) {
    checkRange(m.sType, "wavelength_um", m.wavelength_um, 0.4f, 0.7f);
    params.wavelength_um = static_cast<double>(m.wavelength_um);
    for (const double own : RGB_WAVELENGTH_UM) {  // 0.44f and its like, as the tables know them
      if (m.wavelength_um == static_cast<float>(own)) {
        params.wavelength_um = own;
      }
    }
  }
  if (type == ParticleType::User) {
    if (m.wavelength_um != 0) {
      fail(WLK_ERROR_INVALID_ARGUMENT, m.sType, "wavelength_um",
           "WlkMediumInfo::wavelength_um is set, but a user's table has its own");
    }
    checkUserTable(m);
    params.userAngle = {m.userAngle, m.userCount};
    params.userPhase = {m.userPhase, m.userCount * RGB};
  } else if (m.userCount != 0) {
    fail(WLK_ERROR_INVALID_ARGUMENT, m.sType, "userCount",
         "WlkMediumInfo::userCount is %u, expected 0 for %s", m.userCount, kind.name);
  }
  return params;
}

double checkedAngle(const WlkPhaseQuery& q, uint32_t i) {
  const double angle = q.scatteringAngle[i];
  if (!(angle >= 0 && angle <= std::numbers::pi + ANGLE_SLACK)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, q.sType, "scatteringAngle", "angle %u is %g rad", i, angle);
  }
  return angle;
}

void evalOrders(const Particle& particle, const WlkPhaseQuery& q, double* phase) {
  std::vector<double> at(q.count);
  std::vector<double> values(q.count);
  for (uint32_t i = 0; i < q.count; ++i) {
    const double half = std::sin(0.5 * q.scatteringAngle[i]);
    at[i] = std::min(2 * half * half, 2.0);
  }
  for (size_t c = 0; c < RGB; ++c) {
    const std::vector<double>& p = particle.curve.value[c];
    if (q.orderKind == WLK_ORDER_INTEGER) {
      scatteredInteger(particle.curve.y, p, static_cast<int>(q.order), at, values);
    } else {
      scatteredPoisson(particle.curve.y, p, q.opticalDepth, at, values);
    }
    for (uint32_t i = 0; i < q.count; ++i) {
      phase[i * RGB + c] = values[i];
    }
  }
}

Medium checkedMedium(const WlkMediumInfo* info) {
  const WlkMediumInfo m = copyStruct(info, WLK_STRUCT_MEDIUM_INFO);
  checkNoChain(info);
  checkRange(m.sType, "particle", m.particle, 0, PARTICLE_TYPES - 1);
  const auto type = static_cast<ParticleType>(m.particle);
  const ParticleParams params = checkedParams(m, type);
  checkRange3(m.sType, "singleScatteringAlbedo", m.singleScatteringAlbedo, 0, 1);
  Medium medium = makeMedium(
      type, params,
      {m.singleScatteringAlbedo[0], m.singleScatteringAlbedo[1], m.singleScatteringAlbedo[2]});
  if (medium.particle->empty) {
    fail(WLK_ERROR_INVALID_ARGUMENT, m.sType, "userPhase",
         "WlkMediumInfo::userPhase is positive in a range too narrow to be seen");
  }
  return medium;
}

}  // namespace

WlkResult wlkCreateMedium(WlkContext context, const WlkMediumInfo* info, WlkMedium* medium) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    checkPointer(medium, "medium");
    const Medium value = checkedMedium(info);
    auto tables = std::make_shared<MediumTables>();
    auto nodes = std::make_shared<LateNodes>();
    const uint64_t id = c.media.create();
    c.media.find(id)->medium = value;
    c.media.find(id)->tables = std::move(tables);
    c.media.find(id)->nodes = std::move(nodes);
    medium->id = id;
    return WLK_SUCCESS;
  });
}

WlkResult wlkDestroyMedium(WlkContext context, WlkMedium medium) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    c.medium(medium);
    c.media.destroy(medium.id);
    return WLK_SUCCESS;
  });
}

WlkResult wlkGetMediumOptics(WlkContext context, WlkMedium medium, WlkMediumOptics* optics) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const Particle& particle = *c.medium(medium).medium.particle;
    WlkMediumOptics value = startOutput(optics, WLK_STRUCT_MEDIUM_OPTICS);
    const ParticleOptics& o = particle.optics;
    constexpr double M2_PER_UM2 = 1e-12;
    for (size_t i = 0; i < RGB; ++i) {
      value.extinctionEfficiency[i] = static_cast<float>(o.efficiency[i]);
      value.extinctionCrossSection[i] = o.efficiency[i] * o.area_um2 * M2_PER_UM2;
      value.asymmetry[i] = static_cast<float>(particle.analytic ? meanCosine(particle.phase)
                                                                : meanCosine(particle.curve, i));
      value.forwardFraction[i] = static_cast<float>(forwardFraction(particle.curve, i));
      value.deltaFraction[i] = static_cast<float>(o.delta[i]);
    }
    value.effectiveRadius_um = static_cast<float>(o.effectiveRadius_um);
    finishOutput(value, optics);
    return WLK_SUCCESS;
  });
}

WlkResult wlkEvalPhase(WlkContext context, const WlkPhaseQuery* query, double* phase) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const WlkPhaseQuery q = copyStruct(query, WLK_STRUCT_PHASE_QUERY);
    checkNoChain(query);
    const Particle& particle = *c.medium(q.medium).medium.particle;
    checkRange(q.sType, "orderKind", q.orderKind, WLK_ORDER_SINGLE, WLK_ORDER_POISSON);
    if (q.orderKind == WLK_ORDER_INTEGER) {
      checkRange(q.sType, "order", q.order, 1, 1000);
    }
    if (q.orderKind == WLK_ORDER_POISSON) {
      checkRange(q.sType, "opticalDepth", q.opticalDepth, 0, 1e4);
    }
    if (q.count > 0) {
      checkPointer(q.scatteringAngle, "scatteringAngle");
      checkPointer(phase, "phase");
    }
    for (uint32_t i = 0; i < q.count; ++i) {
      checkedAngle(q, i);
    }
    const bool first =
        q.orderKind == WLK_ORDER_SINGLE || (q.orderKind == WLK_ORDER_INTEGER && q.order == 1);
    if (!first) {
      evalOrders(particle, q, phase);
      return WLK_SUCCESS;
    }
    for (uint32_t i = 0; i < q.count; ++i) {
      for (size_t channel = 0; channel < RGB; ++channel) {
        phase[i * RGB + channel] = evalParticle(particle, channel, q.scatteringAngle[i]);
      }
    }
    return WLK_SUCCESS;
  });
}

WlkResult wlkSamplePhase(WlkContext context, WlkMedium medium, uint32_t channel, uint32_t count,
                         const double* random, double* scatteringAngle, double* density) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const Particle& particle = *c.medium(medium).medium.particle;
    checkRange(0, "channel", channel, 0, RGB - 1);
    if (count > 0) {
      checkPointer(random, "random");
      checkPointer(scatteringAngle, "scatteringAngle");
    }
    for (uint32_t i = 0; i < count; ++i) {
      if (!(random[i] >= 0 && random[i] < 1)) {
        fail(WLK_ERROR_INVALID_ARGUMENT, 0, "random", "random[%u] is %g, expected [0, 1)", i,
             random[i]);
      }
    }
    for (uint32_t i = 0; i < count; ++i) {
      scatteringAngle[i] = sampleParticle(particle, channel, random[i]);
      if (density != nullptr) {
        density[i] = evalParticle(particle, channel, scatteringAngle[i]);
      }
    }
    return WLK_SUCCESS;
  });
}
