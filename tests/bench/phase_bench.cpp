// SPDX-License-Identifier: MIT
// Evaluation cost beside error: ns per value or sample of each phase function, with E ([J23] Eq. 1
// as an integral) and the largest |ln ratio| against Mie theory, droplets of 20 um at 0.55 um.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "particles/medium.hpp"
#include "particles/mie_average.hpp"
#include "particles/phase_table.hpp"
#include "phase_spv.h"
#include "support/compute_runner.hpp"

namespace {

using namespace welkin;
namespace f32 = model::f32;
namespace f64 = model::f64;

constexpr double DIAMETER_um = 20;
constexpr double GREEN_um = 0.55;
constexpr size_t GREEN = 1;  // its channel
constexpr size_t ANGLES = 361;
constexpr size_t BATCH = 4096;

struct Error {
  double e = 0;
  double maxLn = 0;
};

struct Truth {
  std::vector<double> y;  // at even steps of the table coordinate
  std::vector<double> angle;
  MieAverage mie;

  Truth() {
    for (size_t i = 0; i < ANGLES; ++i) {
      y.push_back(f64::curveNode(static_cast<double>(i) / (ANGLES - 1)));
      angle.push_back(2 * std::asin(std::sqrt(std::min(y.back() / 2, 1.0))));
    }
    MieSettings settings;
    settings.nodesPerSpread = 4096;
    mie = averageMie({SizeKind::LogNormal, DIAMETER_um / 2, 0.25}, waterSample(GREEN_um, 10), angle,
                     settings);
  }

  Error errorOf(const std::vector<double>& phase) const {
    Error error;
    double before = 0;
    for (size_t i = 0; i < ANGLES; ++i) {
      const double ln = std::log(phase[i] / mie.phase[i]);
      const double term = std::abs(1 - y[i]) * std::sin(angle[i]) * ln * ln;
      error.maxLn = std::max(error.maxLn, std::abs(ln));
      error.e += i > 0 ? (before + term) / 2 * (angle[i] - angle[i - 1]) : 0;
      before = term;
    }
    return error;
  }

  Error errorOf(const std::function<double(double y)>& phase) const {
    std::vector<double> values;
    for (const double one : y) {
      values.push_back(phase(one));
    }
    return errorOf(values);
  }
};

// Columns of the table: time per value, and the errors.
void count(benchmark::State& state, double values, const Error& error) {
  state.counters["each"] =
      benchmark::Counter(values, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["E"] = error.e;
  state.counters["max_ln"] = error.maxLn;
}

// Times f over a batch of inputs in memory; f returns what the compiler may not drop. Loops over
// the model text are inlined and vectorised as far as the compiler does it, as an engine's are.
template <typename Input, typename F>
void addBatch(const std::string& name, const std::vector<Input>& inputs, const Error& error, F f) {
  benchmark::RegisterBenchmark(name.c_str(), [&inputs, error, f](benchmark::State& state) {
    std::vector<Input> results(inputs.size());
    for (auto _ : state) {
      for (size_t i = 0; i < inputs.size(); ++i) {
        results[i] = f(inputs[i]);
      }
      benchmark::DoNotOptimize(results.data());
      benchmark::ClobberMemory();
    }
    count(state, static_cast<double>(state.iterations()) * static_cast<double>(inputs.size()),
          error);
  });
}

struct Inputs {
  std::vector<float> y, xi;
  std::vector<double> yDouble, xiDouble, angle;

  Inputs() {
    std::mt19937 generator(1);
    for (size_t i = 0; i < BATCH; ++i) {
      xi.push_back(static_cast<float>(generator() >> 8) * 0x1p-24f);
      xiDouble.push_back(static_cast<double>(xi.back()));
      yDouble.push_back(f64::curveNode(static_cast<double>(generator() >> 8) * 0x1p-24));
      y.push_back(static_cast<float>(yDouble.back()));
      angle.push_back(2 * std::asin(std::sqrt(std::min(yDouble.back() / 2, 1.0))));
    }
  }
};

struct Models {
  f32::FogPhase hg, fog;
  Particle particle, closed;
  PhaseCurveF curve;
  std::unique_ptr<PhaseColumn> column;

  explicit Models(const Truth& truth) {
    hg = f32::henyeyGreensteinOnly(static_cast<float>(truth.mie.asymmetry));
    fog = f32::fogPhaseFromDiameter(static_cast<float>(DIAMETER_um));
    ParticleParams params;
    params.diameter_um = DIAMETER_um;
    params.spread = 0.25;
    particle = FOG.make(params);
    params.analytic = true;
    closed = FOG.make(params);
    curve = roundPhaseCurve(particle.curve);
    // The nearest column: what one costs; between two of them two are evaluated.
    const TablePlace place = placeIn(DROPLET_TABLE, std::log(DIAMETER_um), GREEN);
    column =
        std::make_unique<PhaseColumn>(DROPLET_TABLE, place.t < 0.5 ? place.low : place.high, GREEN);
  }
};

double angleOfY(double y) {
  return 2 * std::asin(std::sqrt(std::min(y / 2, 1.0)));
}

void addEvaluation(const Truth& truth, const Inputs& inputs, const Models& models) {
  const auto inFloat = [&](auto f) {
    return truth.errorOf([&](double y) { return static_cast<double>(f(static_cast<float>(y))); });
  };
  const auto hg = [p = models.hg](float y) { return f32::henyeyGreenstein(p.gHg, p.gapHg, y); };
  addBatch("eval/HG, g of Mie, float", inputs.y, inFloat(hg), hg);
  const auto fog = [p = models.fog](float y) { return f32::fogPhase(p, y); };
  addBatch("eval/HG+Draine, parameters given, float", inputs.y, inFloat(fog), fog);
  const auto fogOfDiameter = [](float y) {  // the diameter varies, as with a voxel's
    const float d = static_cast<float>(DIAMETER_um) + 1e-6f * y;
    return f32::fogPhase(f32::fogPhaseFromDiameter(d), y);
  };
  addBatch("eval/HG+Draine, Eq. 4-7 per call, float", inputs.y, inFloat(fogOfDiameter),
           fogOfDiameter);
  const PhaseCurveF& curve = models.curve;
  const auto one = [&curve](float y) { return evalPhaseCurve(curve, GREEN, y); };
  addBatch("eval/curve, green, float", inputs.y, inFloat(one), one);
  addBatch("eval/curve, RGB, float", inputs.y, inFloat(one), [&curve](float y) {
    return evalPhaseCurve(curve, 0, y) + evalPhaseCurve(curve, 1, y) + evalPhaseCurve(curve, 2, y);
  });
  const TableFunction function(DROPLET_TABLE, std::log(DIAMETER_um), GREEN);
  const Error table = truth.errorOf([&](double y) { return function(angleOfY(y)); });
  const PhaseColumn& column = *models.column;
  addBatch("eval/table column, double", inputs.angle, table,
           [&column](double angle) { return column(angle); });
  const auto ofParticle = [&](const Particle& particle) {
    return truth.errorOf([&](double y) { return evalParticle(particle, GREEN, angleOfY(y)); });
  };
  for (const Particle* particle : {&models.closed, &models.particle}) {
    addBatch(
        std::string("eval/evalParticle, ") + (particle->analytic ? "closed" : "table") + ", double",
        inputs.angle, ofParticle(*particle),
        [particle](double angle) { return evalParticle(*particle, GREEN, angle); });
  }
}

void addSampling(const Truth& truth, const Inputs& inputs, const Models& models) {
  const auto error = [&](auto f) { return truth.errorOf(std::function<double(double)>(f)); };
  const auto hgError = error([p = models.hg](double y) {
    return static_cast<double>(f32::fogPhase(p, static_cast<float>(y)));
  });
  const auto fogError = error([&](double y) { return evalPhase(models.closed.phase, y); });
  const auto curveError =
      error([&](double y) { return evalPhaseCurve(models.particle.curve, GREEN, y); });
  addBatch("sample/HG, float", inputs.xi, hgError,
           [p = models.hg](float xi) { return f32::sampleHenyeyGreenstein(p.gHg, p.gapHg, xi); });
  addBatch("sample/HG+Draine, float", inputs.xi, fogError,
           [p = models.fog](float xi) { return f32::sampleFogPhase(p, xi); });
  const PhaseCurveF& curve = models.curve;
  addBatch("sample/curve, green, float", inputs.xi, curveError,
           [&curve](float xi) { return samplePhaseCurve(curve, GREEN, xi).y; });
  for (const Particle* particle : {&models.closed, &models.particle}) {
    addBatch(std::string("sample/sampleParticle, ") + (particle->analytic ? "closed" : "table") +
                 ", double",
             inputs.xiDouble, particle->analytic ? fogError : curveError,
             [particle](double xi) { return sampleParticle(*particle, GREEN, xi); });
  }
}

// What a medium costs before its first value.
void addMaking() {
  const auto add = [](const char* name, const ParticleParams& params) {
    benchmark::RegisterBenchmark(name, [params](benchmark::State& state) {
      for (auto _ : state) {
        benchmark::DoNotOptimize(FOG.make(params));
      }
    })->Unit(benchmark::kMillisecond);
  };
  ParticleParams params;
  params.diameter_um = DIAMETER_um;
  params.spread = 0.25;
  add("make/fog, table", params);
  params.analytic = true;
  add("make/fog, closed", params);
  params.analytic = false;
  params.spread = 0.1;
  add("make/fog, spread 0.1: Mie theory", params);
}

// phase.comp on the device.
class Device {
 public:
  Device(const Truth& truth, const Models& models) {
    const f32::FogPhase& p = models.fog;
    input_ = {0, static_cast<float>(DIAMETER_um), p.gHg, p.gapHg, p.gD, p.gapD, p.alpha, p.weightD};
    for (size_t i = 0; i < kCurveNodes; ++i) {
      for (size_t c = 0; c < RGB; ++c) {
        input_.push_back(models.curve.value[c][i]);
      }
      input_.push_back(0);
    }
    for (const double y : truth.y) {
      input_.push_back(static_cast<float>(y));
    }
  }

  void setHenyeyGreenstein(const f32::FogPhase& hg) {
    input_[2] = hg.gHg;
    input_[3] = hg.gapHg;
  }

  std::vector<double> values(int which) {
    input_[0] = 0;
    const std::vector<float> found = runner_.run(phase_spv, which, input_, GROUPS * SIZE, GROUPS);
    return {found.begin(), found.begin() + ANGLES};
  }

  // Difference of a long and a short loop: the pipeline's making and the start drop out.
  double nsPerValue(int which) {
    double ns[2] = {1e30, 1e30};
    constexpr int LOOPS[2] = {64, 64 * 65};
    for (int repeat = 0; repeat < 5; ++repeat) {
      for (size_t i = 0; i < 2; ++i) {
        input_[0] = static_cast<float>(LOOPS[i]);
        const auto begin = std::chrono::steady_clock::now();
        runner_.run(phase_spv, which, input_, GROUPS * SIZE, GROUPS);
        const std::chrono::duration<double, std::nano> time =
            std::chrono::steady_clock::now() - begin;
        ns[i] = std::min(ns[i], time.count());
      }
    }
    return (ns[1] - ns[0]) / (GROUPS * SIZE * (LOOPS[1] - LOOPS[0]));
  }

  const std::string& name() const { return runner_.deviceName(); }

 private:
  static constexpr uint32_t SIZE = 64;
  static constexpr uint32_t GROUPS = 256;
  support::ComputeRunner runner_;
  std::vector<float> input_;
};

void addDevice(const std::shared_ptr<Device>& device, const Truth& truth, const Models& models) {
  constexpr double MILLION = 1e6;  // the time column: of so many values
  const auto add = [&](const char* name, int which) {
    benchmark::RegisterBenchmark(
        name,
        [&truth, &models, device, which](benchmark::State& state) {
          const f32::FogPhase& first = which == 1 ? models.hg : models.fog;
          device->setHenyeyGreenstein(first);
          for (auto _ : state) {
            state.SetIterationTime(device->nsPerValue(which) * 1e-9 * MILLION);
          }
          count(state, MILLION, which == 0 ? Error{} : truth.errorOf(device->values(which)));
        })
        ->UseManualTime()
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  };
  add("device/loop alone", 0);
  add("device/HG, g of Mie", 1);
  add("device/HG+Draine, parameters given", 2);
  add("device/HG+Draine, Eq. 4-7 per call", 3);
  add("device/curve, RGB", 4);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const Truth truth;
  const Inputs inputs;
  const Models models(truth);
  addEvaluation(truth, inputs, models);
  addSampling(truth, inputs, models);
  addMaking();
  try {
    const auto device = std::make_shared<Device>(truth, models);
    std::fprintf(stderr, "device: %s\n", device->name().c_str());
    addDevice(device, truth, models);
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "no device rows: %s\n", error.what());
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
