// SPDX-License-Identifier: MIT
// welkin_slab_fit: error of the fitted functions of [B08] 5.2 beside that of the shipped table, for
// the canonical slab of optical depth 10, in each set of scattering orders. The fit is least
// squares in ln T, by Levenberg and Marquardt, of
//   ln T = ln P(theta) + ln A(v) + ln X(l) + ln mu_L + ln(ln(d + D) / ln(B + D)) - (d - B)^2 / 2
//   C^2
// with B = B1(v) - B2(l), C(v), D(v) > 1 at each view v and light l, d in m, and 25 nodes of P;
// both are judged where T exceeds 2 % of its maximum. 1 minute.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "tables/canonical_builder.hpp"
#include "tables/slab_orders.hpp"

namespace {

using namespace welkin;

constexpr double PI = std::numbers::pi;
constexpr double THICKNESS = 10;
constexpr double FREE_PATH_m = 36;  // of the paper's cloud without its peak
constexpr size_t VIEWS = 12, SUNS = 12, DEPTHS = 16, AZIMUTHS = 9, ANGLES = 25;
enum { A = 0, B1 = 2 * VIEWS, LOG_C = 4 * VIEWS, LOG_D = 6 * VIEWS, X = 8 * VIEWS };
enum { B2 = X + SUNS, LOG_P = B2 + SUNS, COUNT = LOG_P + ANGLES };

struct Sample {
  size_t view, sun;
  double depth, angle, muLight, logT, tableT;
};

double cosineAt(size_t i, size_t count) {
  const double root = 0.15 + 0.85 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
  return root * root;
}

// What depends on the four parameters that are not linear.
double curve(double d, double b, double logC, double logD) {
  const double edge = 1 + std::exp(logD);
  const double at = std::max(b, 0.01 - edge + 1);
  const double c = std::exp(logC);
  return std::log(std::log(d + edge) / std::log(at + edge)) - (d - b) * (d - b) / (2 * c * c);
}

struct Terms {
  std::array<size_t, 8> index;
  std::array<double, 8> slope;
  double value;
};

Terms evaluate(const std::vector<double>& p, const Sample& s) {
  const double place = s.angle / PI * (ANGLES - 1);
  const size_t low = std::min(static_cast<size_t>(place), ANGLES - 2);
  const double t = place - static_cast<double>(low);
  const double b = p[B1 + s.view] - p[B2 + s.sun];
  const double logC = p[LOG_C + s.view];
  const double logD = p[LOG_D + s.view];
  const double d = s.depth * FREE_PATH_m;
  constexpr double STEP = 1e-4;
  const double byB = (curve(d, b + STEP, logC, logD) - curve(d, b - STEP, logC, logD)) / 2 / STEP;
  const double byC = (curve(d, b, logC + STEP, logD) - curve(d, b, logC - STEP, logD)) / 2 / STEP;
  const double byD = (curve(d, b, logC, logD + STEP) - curve(d, b, logC, logD - STEP)) / 2 / STEP;
  Terms result;
  result.index = {A + s.view,  X + s.sun,  LOG_P + low,    LOG_P + low + 1,
                  B1 + s.view, B2 + s.sun, LOG_C + s.view, LOG_D + s.view};
  result.slope = {1, 1, 1 - t, t, byB, -byB, byC, byD};
  result.value = p[A + s.view] + p[X + s.sun] + (1 - t) * p[LOG_P + low] + t * p[LOG_P + low + 1] +
                 std::log(s.muLight) + curve(d, b, logC, logD);
  return result;
}

double cost(const std::vector<double>& p, const std::vector<Sample>& samples) {
  double sum = 0;
  for (const Sample& s : samples) {
    const double r = evaluate(p, s).value - s.logT;
    sum += r * r;
  }
  return sum;
}

// Solves the symmetric system by Cholesky; false if it is not positive.
bool solve(std::vector<double> a, std::vector<double>& x) {
  constexpr size_t n = COUNT;
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j <= i; ++j) {
      double sum = a[i * n + j];
      for (size_t k = 0; k < j; ++k) {
        sum -= a[i * n + k] * a[j * n + k];
      }
      if (i == j && !(sum > 0)) {
        return false;
      }
      a[i * n + j] = i == j ? std::sqrt(sum) : sum / a[j * n + j];
    }
  }
  for (size_t i = 0; i < n; ++i) {
    for (size_t k = 0; k < i; ++k) {
      x[i] -= a[i * n + k] * x[k];
    }
    x[i] /= a[i * n + i];
  }
  for (size_t i = n; i-- > 0;) {
    for (size_t k = i + 1; k < n; ++k) {
      x[i] -= a[k * n + i] * x[k];
    }
    x[i] /= a[i * n + i];
  }
  return true;
}

std::vector<double> fit(const std::vector<Sample>& samples) {
  std::vector<double> p(COUNT);
  std::fill_n(p.begin() + LOG_C, 2 * VIEWS, std::log(THICKNESS * FREE_PATH_m));
  std::fill_n(p.begin() + LOG_D, 2 * VIEWS, std::log(30.0));
  std::fill_n(p.begin() + B1, 2 * VIEWS, 50.0);
  double best = cost(p, samples);
  double damping = 1;
  for (int step = 0; step < 150; ++step) {
    std::vector<double> matrix(COUNT * COUNT);
    std::vector<double> right(COUNT);
    for (const Sample& s : samples) {
      const Terms terms = evaluate(p, s);
      for (size_t i = 0; i < 8; ++i) {
        right[terms.index[i]] -= terms.slope[i] * (terms.value - s.logT);
        for (size_t j = 0; j < 8; ++j) {
          matrix[terms.index[i] * COUNT + terms.index[j]] += terms.slope[i] * terms.slope[j];
        }
      }
    }
    for (size_t i = 0; i < COUNT; ++i) {
      matrix[i * COUNT + i] = matrix[i * COUNT + i] * (1 + damping) + 1e-9;
    }
    if (!solve(matrix, right)) {
      damping *= 10;
      continue;
    }
    std::vector<double> next = p;
    for (size_t i = 0; i < COUNT; ++i) {
      next[i] += right[i];
    }
    const double found = cost(next, samples);
    if (found < best) {
      p = next;
      best = found;
      damping = std::max(damping / 4, 1e-6);
    } else {
      damping *= 5;
    }
  }
  return p;
}

double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(part * static_cast<double>(values.size() - 1))];
}

}  // namespace

int main() {
  const std::vector<double> chi = canonicalMoments(canonicalPhase(), CANONICAL_TERMS);
  const CanonicalTable table = decodeCanonical(shippedCanonical());
  const SlabMedium medium(chi, THICKNESS);
  const SlabTail tail(medium);
  std::vector<double> mu;
  std::vector<double> suns;
  std::vector<double> depths;
  for (size_t i = 0; i < VIEWS; ++i) {
    mu.push_back(cosineAt(i, VIEWS));
  }
  for (size_t i = 0; i < SUNS; ++i) {
    suns.push_back(cosineAt(i, SUNS));
  }
  for (size_t i = 0; i < DEPTHS; ++i) {
    depths.push_back(THICKNESS * (static_cast<double>(i) + 0.5) / DEPTHS);
  }
  const SlabDirections views = medium.directions(mu, std::vector<double>(VIEWS));
  std::vector<SlabOrders> orders;
  for (size_t i = 0; i < SUNS; i += SLAB_LANES) {
    orders.emplace_back(tail, std::span(suns).subspan(i, SLAB_LANES));
  }
  std::printf("orders from: fit median, p90, rms of ln; table median, p90\n");
  for (size_t set = 0; set < SLAB_SETS; ++set) {
    std::vector<Sample> samples;
    double most = 0;
    for (size_t batch = 0; batch < orders.size(); ++batch) {
      const SlabLight light = orders[batch].light(set, views, depths);
      for (size_t i = 0; i < SLAB_LANES * 2 * VIEWS * DEPTHS * AZIMUTHS; ++i) {
        const size_t a = i % AZIMUTHS;
        const size_t d = i / AZIMUTHS % DEPTHS;
        const size_t v = i / AZIMUTHS / DEPTHS % (2 * VIEWS);
        const size_t lane = i / AZIMUTHS / DEPTHS / (2 * VIEWS);
        const bool up = v >= VIEWS;
        const double cosine = up ? -mu[v % VIEWS] : mu[v % VIEWS];
        const double sun = suns[batch * SLAB_LANES + lane];
        const double phi = PI * (static_cast<double>(a) + 0.5) / AZIMUTHS;
        const double radiance = light.at(lane, v % VIEWS, up, d, phi).radiance;
        most = std::max(most, radiance);
        const double sines = std::sqrt((1 - cosine * cosine) * (1 - sun * sun));
        samples.push_back(
            {v, batch * SLAB_LANES + lane, depths[d],
             std::acos(std::clamp(cosine * sun + sines * std::cos(phi), -1.0, 1.0)), sun,
             std::log(std::max(radiance, 1e-30)),
             table.transport(set, {THICKNESS, depths[d], cosine, phi, sun}).radiance});
      }
    }
    std::erase_if(samples, [&](const Sample& s) { return std::exp(s.logT) < 0.02 * most; });
    const std::vector<double> p = fit(samples);
    std::vector<double> fitted;
    std::vector<double> tabulated;
    for (const Sample& s : samples) {
      fitted.push_back(std::abs(std::exp(evaluate(p, s).value - s.logT) - 1));
      tabulated.push_back(std::abs(s.tableT / std::exp(s.logT) - 1));
    }
    std::printf("%d: %.3f %.3f %.3f; %.4f %.4f\n", SLAB_ORDERS[set], quantile(fitted, 0.5),
                quantile(fitted, 0.9),
                std::sqrt(cost(p, samples) / static_cast<double>(samples.size())),
                quantile(tabulated, 0.5), quantile(tabulated, 0.9));
    std::fflush(stdout);
  }
  return 0;
}
