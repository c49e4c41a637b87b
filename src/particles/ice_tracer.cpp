// SPDX-License-Identifier: MIT
#include "particles/ice_tracer.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace welkin {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double APOTHEM = 0.86602540378443864676;  // sqrt(3) / 2, of the hexagon with a = 1
constexpr int MAX_REFLECTIONS = 1000;  // inside: total reflection holds some for hundreds
constexpr int MAX_TILTS = 32;          // tries; then the facet stays untilted: 1e-4 at roughness 2

struct Vec {
  double x, y, z;
};

Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec operator-(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec operator*(double s, Vec a) {
  return {s * a.x, s * a.y, s * a.z};
}
double dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The faces in 4 pairs of parallels: normal n and -n, at distance reach from the centre; t1 and t2
// span the plane.
struct Pair {
  Vec normal, t1, t2;
  double reach;
};

using Prism = std::array<Pair, 4>;

Prism prismOf(double aspect) {
  constexpr Vec UP = {0, 0, 1};
  return {{{{1, 0, 0}, {0, 1, 0}, UP, APOTHEM},
           {{0.5, APOTHEM, 0}, {-APOTHEM, 0.5, 0}, UP, APOTHEM},
           {{-0.5, APOTHEM, 0}, {-APOTHEM, -0.5, 0}, UP, APOTHEM},
           {UP, {1, 0, 0}, {0, 1, 0}, aspect}}};
}

// SplitMix64, Steele, Lea and Flood 2014.
struct Random {
  uint64_t state;

  uint64_t next() {
    state += 0x9e3779b97f4a7c15;
    uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  double uniform() { return static_cast<double>((next() >> 11) + 1) * 0x1p-53; }  // (0, 1]
};

// Standard normal numbers by the ziggurat of 128 layers of equal area V, the lowest one with the
// tail beyond R: Marsaglia and Tsang 2000; layer and place from separate bits, as Doornik 2005.
// Twice as fast as the polar method, exact like it.
class Ziggurat {
 public:
  Ziggurat() {
    width_[0] = V / std::exp(-R * R / 2);
    width_[1] = R;
    for (size_t i = 2; i < LAYERS; ++i) {
      const double last = width_[i - 1];
      width_[i] = std::sqrt(-2 * std::log(V / last + std::exp(-last * last / 2)));
    }
    width_[LAYERS] = 0;
  }

  double draw(Random& random) const {
    for (;;) {
      const uint64_t bits = random.next();
      const size_t layer = bits % LAYERS;
      const double x = static_cast<double>(static_cast<int64_t>(bits) >> 11) * 0x1p-52 *
                       width_[layer];  // in +-width
      if (std::abs(x) < width_[layer + 1]) {
        return x;
      }
      if (layer == 0) {
        return std::copysign(tail(random), x);
      }
      const double low = std::exp((x * x - width_[layer] * width_[layer]) / 2);
      const double high = std::exp((x * x - width_[layer + 1] * width_[layer + 1]) / 2);
      if (low + random.uniform() * (high - low) < 1) {
        return x;
      }
    }
  }

 private:
  static constexpr size_t LAYERS = 128;
  static constexpr double R = 3.442619855899;
  static constexpr double V = 9.91256303526217e-3;

  static double tail(Random& random) {
    double x = 0;
    double y = 0;
    do {
      x = -std::log(random.uniform()) / R;
      y = -std::log(random.uniform());
    } while (2 * y < x * x);
    return R + x;
  }

  std::array<double, LAYERS + 1> width_;
};

// Points of the unit 4-cube, k times powers of 1 / g modulo 1, g^5 = g + 1: the generalised golden
// ratio (Roberts 2018), in 64-bit fractions, so that no precision is lost at large k.
class Points {
 public:
  explicit Points(uint64_t seed) {
    Random random{seed};
    double power = 1;
    for (size_t i = 0; i < 4; ++i) {
      power /= 1.16730397826141868426;
      step_[i] = static_cast<uint64_t>(power * 0x1p64);
      now_[i] = random.next();
    }
  }

  std::array<double, 4> next() {
    std::array<double, 4> point;
    for (size_t i = 0; i < 4; ++i) {
      now_[i] += step_[i];
      point[i] = static_cast<double>(now_[i] >> 11) * 0x1p-53;
    }
    return point;
  }

 private:
  std::array<uint64_t, 4> step_, now_;
};

// Bins of the angle between two directions, searched by the key sin(t / 2), for t > 90 degrees
// sqrt(2) - cos(t / 2): ascending, almost linear in t and exact at both ends.
class Bins {
 public:
  explicit Bins(std::span<const double> edges) : keys_(edges.size()) {
    for (size_t i = 0; i < edges.size(); ++i) {
      keys_[i] = edges[i] > PI / 2 ? ROOT - std::cos(edges[i] / 2) : std::sin(edges[i] / 2);
    }
    keys_.front() = 0;
    keys_.back() = 2;  // above all keys
    first_.resize(2 * edges.size());
    scale_ = static_cast<double>(first_.size()) / ROOT;
    size_t bin = 0;
    for (size_t cell = 0; cell < first_.size(); ++cell) {
      while (keys_[bin + 1] * scale_ <= static_cast<double>(cell)) {
        ++bin;
      }
      first_[cell] = static_cast<uint32_t>(
          bin > 0 ? bin - 1 : 0);  // the product is rounded: start a bin early
    }
  }

  // hav: sin^2(t / 2) of the angle between the two.
  size_t find(Vec from, Vec to, double hav) const {
    double key = std::sqrt(hav);
    if (hav > 0.5) {
      const Vec sum = from + to;
      key = ROOT - std::sqrt(dot(sum, sum)) / 2;
    }
    const double cell = std::min(key * scale_, static_cast<double>(first_.size() - 1));
    size_t bin = first_[static_cast<uint32_t>(cell)];
    while (key >= keys_[bin + 1]) {
      ++bin;
    }
    return bin;
  }

 private:
  static constexpr double ROOT = std::numbers::sqrt2;
  std::vector<double> keys_;
  std::vector<uint32_t> first_;  // bin to start from, per cell of the key
  double scale_ = 0;
};

struct Sums {
  struct Bin {
    double energy, square;
  };
  std::vector<Bin> bins;
  double delta = 0, lost = 0, cosine = 0;

  // Light of this weight leaves the crystal.
  void leave(const Bins& search, Vec from, Vec to, double weight) {
    constexpr double SAME = 1e-12;  // rad^2: 1e-6 squared
    const Vec change = to - from;
    const double hav = dot(change, change) / 4;
    if (4 * hav < SAME) {
      delta += weight;
      return;
    }
    const size_t bin = search.find(from, to, hav);
    bins[bin].energy += weight;
    bins[bin].square += weight * weight;
    cosine += weight * (1 - 2 * hav);
  }
};

// What becomes of a ray at a facet.
struct Split {
  Vec reflected, refracted;
  double reflectance;  // 1: nothing is refracted
};

// normal: towards the side the ray comes from; eta: near index / far index.
Split splitAt(Vec ray, Vec normal, double cosine, double eta) {
  const Vec reflected = ray + 2 * cosine * normal;
  const double sine2 = eta * eta * (1 - cosine * cosine);
  if (sine2 >= 1) {
    return {reflected, reflected, 1};
  }
  const double below = std::sqrt(1 - sine2);
  const double s = (eta * cosine - below) / (eta * cosine + below);
  const double p = (cosine - eta * below) / (cosine + eta * below);
  return {reflected, eta * ray + (eta * cosine - below) * normal, (s * s + p * p) / 2};
}

class Tracer {
 public:
  Tracer(const IceCrystal& crystal, double index, const Bins& bins, Sums& sums, Random random,
         double minWeight)
      : prism_(prismOf(crystal.aspect)),
        roughness_(crystal.roughness),
        index_(index),
        minWeight_(minWeight),
        bins_(bins),
        sums_(sums),
        random_(random) {}

  // A ray through `at` (anywhere on its line) towards `from`; false when it misses.
  template <bool ROUGH>
  bool trace(Vec at, Vec from) {
    double enter = -1e300;
    double leave = 1e300;
    size_t face = 0;
    for (size_t k = 0; k < 4; ++k) {
      const double speed = dot(from, prism_[k].normal);
      const double place = dot(at, prism_[k].normal);
      const double inverse = 1 / std::max(std::abs(speed), 1e-300);
      const double middle = (speed < 0 ? place : -place) * inverse;
      const double half = prism_[k].reach * inverse;
      if (middle - half > enter) {
        enter = middle - half;
        face = k;
      }
      leave = std::min(leave, middle + half);
    }
    if (enter >= leave) {
      return false;
    }
    const bool up = dot(from, prism_[face].normal) < 0;  // it meets the face on +normal's side
    const Split first = meet<ROUGH>(from, face, up ? 1 : -1, 1 / index_);
    sums_.leave(bins_, from, first.reflected, first.reflectance);
    inside<ROUGH>(at + enter * from, from, first.refracted, 1 - first.reflectance);
    return true;
  }

 private:
  // The facet of a face, its normal n * side on the ray's side. A rough one is tilted; a tilt that
  // hides it from the ray, or sends the ray through the face where it must not go, is drawn again.
  template <bool ROUGH>
  Split meet(Vec ray, size_t face, double side, double eta) {
    const Pair& pair = prism_[face];
    const Vec flat = side * pair.normal;
    if constexpr (ROUGH) {
      for (int i = 0; i < MAX_TILTS; ++i) {
        const double a = roughness_ * ziggurat_.draw(random_);
        const double b = roughness_ * ziggurat_.draw(random_);
        const Vec tilted = flat + a * pair.t1 + b * pair.t2;
        const Vec normal = 1 / std::sqrt(dot(tilted, tilted)) * tilted;
        const double cosine = -dot(ray, normal);
        if (cosine <= 0) {
          continue;
        }
        const Split split = splitAt(ray, normal, cosine, eta);
        if (dot(split.reflected, flat) > 0 &&
            (split.reflectance == 1 || dot(split.refracted, flat) < 0)) {
          return split;
        }
      }
    }
    return splitAt(ray, flat, -dot(ray, flat), eta);
  }

  // Follows the ray `going` inside from `at` on the surface; `from` is its first direction.
  template <bool ROUGH>
  void inside(Vec at, Vec from, Vec going, double weight) {
    for (int i = 0; i < MAX_REFLECTIONS && weight >= minWeight_; ++i) {
      double way = 1e300;
      size_t face = 0;
      double side = 0;
      for (size_t k = 0; k < 4; ++k) {  // of each pair only the face ahead; none is behind
        const double speed = dot(going, prism_[k].normal);
        const double place = dot(at, prism_[k].normal);
        const double sign = speed < 0 ? -1 : 1;
        const double t = (prism_[k].reach - sign * place) / std::max(sign * speed, 1e-300);
        if (t < way) {
          way = t;
          face = k;
          side = -sign;
        }
      }
      at = at + std::max(way, 0.0) * going;
      const Split split = meet<ROUGH>(going, face, side, index_);
      if (split.reflectance < 1) {
        sums_.leave(bins_, from, split.refracted, weight * (1 - split.reflectance));
        weight *= split.reflectance;
      }
      going = split.reflected;
    }
    sums_.lost += weight;
  }

  Prism prism_;
  double roughness_, index_, minWeight_;
  const Bins& bins_;
  Sums& sums_;
  Random random_;
  Ziggurat ziggurat_;
};

// Throws rays at the disk around the crystal, from directions of one of the 24 parts that the
// prism's symmetry makes of the sphere, until enough of them hit; returns how many were thrown.
template <bool ROUGH>
size_t throwRays(Tracer& tracer, Points& points, double radius, size_t rays) {
  size_t thrown = 0;
  for (size_t hits = 0; hits < rays; ++thrown) {
    const std::array<double, 4> point = points.next();
    const double up = point[0];
    const double flat = std::sqrt((1 - up) * (1 + up));
    const double azimuth = PI / 6 * point[1];
    const double c = std::cos(azimuth);
    const double s = std::sin(azimuth);
    const double away = radius * std::sqrt(point[2]);
    const double u = away * std::cos(2 * PI * point[3]);
    const double v = away * std::sin(2 * PI * point[3]);
    const Vec across = {-s, c, 0};
    const Vec over = {-up * c, -up * s, flat};
    hits += tracer.trace<ROUGH>(u * across + v * over, {flat * c, flat * s, up}) ? 1U : 0U;
  }
  return thrown;
}

}  // namespace

double fresnelReflectance(double cosine, double index) {
  return splitAt({0, 0, -1}, {0, 0, 1}, cosine, 1 / index).reflectance;
}

IceScattering traceIce(const IceCrystal& crystal, double index, std::span<const double> edges,
                       const IceTracing& tracing) {
  assert(crystal.aspect >= 0.01 && crystal.aspect <= 100 && crystal.roughness >= 0);
  assert(index >= 1 && tracing.rays > 0 && edges.size() >= 2);
  const Bins bins(edges);
  Sums sums;
  sums.bins.resize(edges.size() - 1);
  Random random{tracing.seed};
  Points points(random.next());
  Tracer tracer(crystal, index, bins, sums, Random{random.next()}, tracing.minWeight);
  const double radius = std::sqrt(1 + crystal.aspect * crystal.aspect);
  const size_t thrown = crystal.roughness > 0
                            ? throwRays<true>(tracer, points, radius, tracing.rays)
                            : throwRays<false>(tracer, points, radius, tracing.rays);
  const auto rays = static_cast<double>(tracing.rays);
  IceScattering result;
  double total = 0;
  for (const Sums::Bin& bin : sums.bins) {
    total += bin.energy;
    result.energy.push_back(bin.energy / rays);
    result.variance.push_back(bin.square / (rays * rays));
  }
  result.deltaTransmission = sums.delta / rays;
  result.lost = sums.lost / rays;
  result.projectedArea = PI * radius * radius * rays / static_cast<double>(thrown);
  result.asymmetry = (sums.cosine + sums.delta) / (total + sums.delta);
  result.asymmetryOfBins = total > 0 ? sums.cosine / total : 0;
  return result;
}

}  // namespace welkin
