// SPDX-License-Identifier: MIT
// Sweeps of the model text: a million arguments of one function, over all of its documented domain
// with the edges of float among them, computed in float and in double.
//
// WELKIN_SWEEP_POINTS takes another number of arguments, WELKIN_SWEEP_RESULTS names a file to which
// rows are appended as docs/results/sweep.csv has them (tools/sweep_table).
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "model/model.hpp"
#include "support/tolerance.hpp"

namespace welkin::test {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;

inline constexpr int TRAPPED = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
// An ordered comparison with NaN is an invalid operation, and what finiteValue is for.
inline constexpr int TRAPPED_BUT_NAN = FE_DIVBYZERO | FE_OVERFLOW;
inline constexpr double LARGEST = std::numeric_limits<float>::max();

// Error of so many roundings of float, none of which is magnified.
constexpr double roundings(double count) {
  return count * EPS_FLOAT;
}

// Functions of a microsecond and of some get one argument of so many.
inline constexpr int SLOW = 4;
inline constexpr int COSTLY = 10;

// What holds of every value of a function. It may be off by `bound` times the truth's size or
// `floor`; bound 0 compares ranges only, where the arguments' own rounding decides (a ray that just
// meets the planet or not).
struct Claim {
  double low;
  double high;
  double bound = 0.0;
  double floor = 0.0;
  int share = 1;
  int trapped = TRAPPED;
};

class Arguments {
 public:
  // In [low, high), one in 16 an end.
  float uniform(float low, float high) {
    const uint64_t bits = random_();
    const float t = static_cast<float>(bits >> 40) * 0x1p-24f;
    return edge(bits) ? ((bits & 16) != 0 ? low : high) : low + (high - low) * t;
  }
  // Even steps of the logarithm between two magnitudes; one in 16 is 0.
  float magnitude(float low, float high) {
    const uint64_t bits = random_();
    return edge(bits) ? 0.0f : logarithmic(bits, low, high);
  }
  // The same without zeros.
  float positive(float low, float high) { return logarithmic(random_(), low, high); }
  float signedMagnitude(float low, float high) {
    return (random_() & 1) != 0 ? magnitude(low, high) : -magnitude(low, high);
  }
  float anyBits() {
    const auto bits = static_cast<uint32_t>(random_());
    float x = 0;
    std::memcpy(&x, &bits, sizeof x);
    return x;
  }
  // 0 ... count - 1.
  float index(int count) { return static_cast<float>(random_() % static_cast<uint64_t>(count)); }
  // The cosine of an angle, dense around the horizon and the poles.
  float cosine() {
    const float x = signedMagnitude(1e-8f, 1.0f);
    return (random_() & 1) != 0 ? x : std::copysign(1.0f - std::fabs(x), x);
  }
  std::array<float, 3> direction() {
    const double y = double{cosine()};
    const double azimuth = double{uniform(0.0f, 6.2831853f)};
    const double r = std::sqrt(std::fmax(1.0 - y * y, 0.0));
    return {static_cast<float>(r * std::cos(azimuth)), static_cast<float>(y),
            static_cast<float>(r * std::sin(azimuth))};
  }

 private:
  static bool edge(uint64_t bits) { return (bits & 15) == 0; }
  static float logarithmic(uint64_t bits, float low, float high) {
    const double t = static_cast<double>(bits >> 11) * 0x1p-53;
    const double x = low * std::exp(t * std::log(double{high} / double{low}));
    return std::fmin(static_cast<float>(x), high);
  }
  std::mt19937_64 random_{20251};
};

// One array of several drawn ones.
template <size_t... N>
std::array<float, (N + ...)> joined(const std::array<float, N>&... parts) {
  std::array<float, (N + ...)> all{};
  size_t at = 0;
  const auto append = [&](const auto& part) {
    for (const float x : part) {
      all[at++] = x;
    }
  };
  (append(parts), ...);
  return all;
}

// Three numbers from `first` on as a vector.
template <typename Vec3, typename Real, size_t N>
Vec3 vectorOf(const std::array<Real, N>& x, size_t first) {
  return Vec3(x[first], x[first + 1], x[first + 2]);
}

// Results of any kind as a list of numbers.
template <typename Real>
requires std::is_floating_point_v<Real> std::array<double, 1> listed(Real x) {
  return {double{x}};
}
template <typename Real, size_t M>
std::array<double, M> listed(const std::array<Real, M>& x) {
  std::array<double, M> list{};
  std::copy(x.begin(), x.end(), list.begin());
  return list;
}
template <glm::length_t L, typename Real, glm::qualifier Q>
std::array<double, size_t{L}> listed(const glm::vec<L, Real, Q>& v) {
  std::array<double, size_t{L}> list{};
  for (glm::length_t i = 0; i < L; ++i) {
    list[static_cast<size_t>(i)] = double{v[i]};
  }
  return list;
}

inline uint64_t sweepPoints() {
  const char* text = std::getenv("WELKIN_SWEEP_POINTS");
  return text == nullptr ? 1000000 : std::strtoull(text, nullptr, 10);
}

template <size_t N>
std::string textOf(const std::array<float, N>& at) {
  std::string list;
  for (const float x : at) {
    char text[32];
    std::snprintf(text, sizeof text, " %.9g", double{x});
    list += text;
  }
  return list;
}

// To the output and, if asked for, to the file of results.
inline void report(const char* name, uint64_t points, const Claim& claim, double worst,
                   const std::string& at, double seconds) {
  const auto count = static_cast<unsigned long long>(points);
  if (claim.bound > 0.0) {
    std::printf("%-28s %llu points, %.2f s, worst error %.2g of %.2g at%s\n", name, count, seconds,
                worst, claim.bound, at.c_str());
  } else {
    std::printf("%-28s %llu points, %.2f s, in range, relative difference %.2g\n", name, count,
                seconds, worst);
  }
  const char* path = std::getenv("WELKIN_SWEEP_RESULTS");
  std::FILE* file = path == nullptr ? nullptr : std::fopen(path, "a");
  if (file != nullptr) {
    std::fprintf(file, "\"%s\",%llu,%.3g,%.3g,%s,%.2f\n", name, count,
                 claim.bound > 0.0 ? worst : 0.0, claim.bound,
                 claim.bound > 0.0 ? at.c_str() + 1 : "", seconds);
    std::fclose(file);
  }
}

inline std::string raisedText(int raised) {
  return std::string((raised & FE_INVALID) != 0 ? ", invalid" : "") +
         ((raised & FE_DIVBYZERO) != 0 ? ", division by zero" : "") +
         ((raised & FE_OVERFLOW) != 0 ? ", overflow" : "");
}

// `draw` gives N floats, `single` and `full` compute from them in float and double.
template <size_t N, typename Draw, typename Single, typename Full>
void sweep(const char* name, const Claim& claim, const Draw& draw, const Single& single,
           const Full& full) {
  const auto start = std::chrono::steady_clock::now();
  const uint64_t points = std::max<uint64_t>(sweepPoints() / static_cast<uint64_t>(claim.share), 1);
  Arguments arguments;
  double worst = 0.0;
  std::array<float, N> worstAt{};
  int bad = 0;
  for (uint64_t n = 0; n < points && bad < 3; ++n) {
    const std::array<float, N> at = draw(arguments);
    // Clearing costs more than most functions, and what is drawn and compared raises little.
    if (std::fetestexcept(TRAPPED) != 0) {
      std::feclearexcept(FE_ALL_EXCEPT);
    }
    // Read anew, so that no compiler computes before the flags are cleared; stored, so that none
    // computes after they are read.
    std::array<float, N> used{};
    for (size_t i = 0; i < N; ++i) {
      used[i] = *const_cast<const volatile float*>(&at[i]);
    }
    const auto value = listed(single(used));
    const auto truth = listed(full(used));
    volatile double kept[2 * std::tuple_size_v<decltype(value)>];
    for (size_t i = 0; i < value.size(); ++i) {
      kept[2 * i] = value[i];
      kept[2 * i + 1] = truth[i];
    }
    const int raised = std::fetestexcept(claim.trapped);
    for (size_t i = 0; i < value.size(); ++i) {
      const double v = kept[2 * i];
      const double t = kept[2 * i + 1];
      const bool fits = v >= claim.low && v <= claim.high && t >= claim.low && t <= claim.high;
      // Of 0 and 0 no quotient.
      const double error = v == t ? 0.0 : std::fabs(v - t) / std::fmax(std::fabs(t), claim.floor);
      if (error > worst) {
        worst = error;
        worstAt = at;
      }
      if ((raised != 0 && i == 0) || !fits) {
        ++bad;
        ADD_FAILURE() << name << " of" << textOf(at) << ": number " << i << " in float " << v
                      << ", in double " << t << (fits ? "" : ", out of range")
                      << raisedText(raised);
      }
    }
  }
  if (claim.bound > 0.0) {
    EXPECT_LE(worst, claim.bound) << name << " at" << textOf(worstAt);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  report(name, points, claim, worst, textOf(worstAt), seconds.count());
}

// SWEEP(N, "function, variant", claim, drawn from a, what is computed from x). The first word is
// the function's name: ModelSweep.LeavesNoFunctionOut.
#define SWEEP(N, name, claim, drawn, ...)                                                 \
  welkin::test::sweep<N>(                                                                 \
      name, claim, [](welkin::test::Arguments& a) { return std::array<float, N> drawn; }, \
      [](const std::array<float, N>& x) {                                                 \
        namespace m = welkin::model::f32;                                                 \
        using real = float;                                                               \
        (void)sizeof(real);                                                               \
        return __VA_ARGS__;                                                               \
      },                                                                                  \
      [](const std::array<float, N>& floats) {                                            \
        namespace m = welkin::model::f64;                                                 \
        using real = double;                                                              \
        std::array<double, N> x{};                                                        \
        std::copy(floats.begin(), floats.end(), x.begin());                               \
        (void)sizeof(real);                                                               \
        return __VA_ARGS__;                                                               \
      })

}  // namespace welkin::test
