// SPDX-License-Identifier: MIT
#include "tables/surface_ambient.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/model.hpp"

namespace welkin {
namespace {

using namespace model::f64;

constexpr auto DEPTHS = static_cast<size_t>(SHARE_DEPTHS);
constexpr auto THICKNESSES = static_cast<size_t>(SHARE_THICKNESSES);
constexpr auto VIEWS = static_cast<size_t>(SHARE_VIEWS);

// Gauss-Legendre on [0, 1].
constexpr std::array<double, 6> COSINE = {0.03376524289842397, 0.16939530676686776,
                                          0.38069040695840156, 0.61930959304159849,
                                          0.83060469323313224, 0.96623475710157603};
constexpr std::array<double, 6> WEIGHT = {0.08566224618958525, 0.18038078652406930,
                                          0.23395696728634552, 0.23395696728634552,
                                          0.18038078652406930, 0.08566224618958525};
constexpr int AZIMUTHS = 6;

double henyeyGreenstein(double cosine, double g) {
  const double q = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * std::numbers::pi * q * std::sqrt(q));
}

// Source of all orders, of light of radiance 1 from the lit face's side.
double sourceOf(const SurfaceSource& source, double asymmetry, double thickness, double depth,
                double muView) {
  double sum = 0;
  for (size_t i = 0; i < COSINE.size(); ++i) {
    const double mu = COSINE[i];
    for (int j = 0; j < AZIMUTHS; ++j) {
      const double phi = std::numbers::pi * (j + 0.5) / AZIMUTHS;
      const double cosine =
          muView * mu + std::sqrt((1 - muView * muView) * (1 - mu * mu)) * std::cos(phi);
      double light = henyeyGreenstein(cosine, asymmetry) * std::exp(-depth / mu);
      for (size_t set = 0; set < CANONICAL_SETS; ++set) {
        light += surfaceSourceAt(source, set, {thickness, depth, mu, muView, phi});
      }
      sum += WEIGHT[i] * 2 * std::numbers::pi / AZIMUTHS * light;
    }
  }
  return sum;
}

// Inverse of canonicalDepth, by halving.
double depthAt(double coordinate, double thickness) {
  double low = 0;
  double high = thickness;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (canonicalDepth(middle, thickness) < coordinate ? low : high) = middle;
  }
  return (low + high) / 2;
}

double partOf(size_t node, size_t count) {
  return static_cast<double>(node) / static_cast<double>(count - 1);
}

double thicknessOf(size_t node) {
  return CANONICAL_THINNEST *
         std::pow(CANONICAL_THICKEST / CANONICAL_THINNEST, partOf(node, THICKNESSES));
}

size_t placeOf(size_t depth, size_t thickness, size_t view) {
  return (view * THICKNESSES + thickness) * DEPTHS + depth;
}

}  // namespace

SurfaceAmbient surfaceAmbient(const SurfaceSource& source, double asymmetry) {
  SurfaceAmbient table;
  table.size = {DEPTHS, THICKNESSES * VIEWS * 2};
  std::vector<double> light(table.size[0] * table.size[1]);
  const double root = std::sqrt(CANONICAL_COSINE);
  for (size_t t = 0; t < THICKNESSES; ++t) {
    const double thickness = thicknessOf(t);
    for (size_t d = 0; d < DEPTHS; ++d) {
      const double depth = depthAt(partOf(d, DEPTHS), thickness);
      for (size_t view = 0; view < 2 * VIEWS; ++view) {
        const double cosine = root + partOf(view % VIEWS, VIEWS) * (1 - root);
        const double mu = (view < VIEWS ? 1 : -1) * cosine * cosine;
        light[placeOf(d, t, view)] = sourceOf(source, asymmetry, thickness, depth, mu);
      }
    }
  }
  table.share.resize(light.size());
  for (size_t t = 0; t < THICKNESSES; ++t) {
    const double thickness = thicknessOf(t);
    for (size_t d = 0; d < DEPTHS; ++d) {
      const double diffuse = diffuseLeft(thickness, depthAt(partOf(d, DEPTHS), thickness));
      for (size_t view = 0; view < 2 * VIEWS; ++view) {
        const double lit = light[placeOf(d, t, view)];
        const double other = light[placeOf(DEPTHS - 1 - d, t, (view + VIEWS) % (2 * VIEWS))];
        table.share[placeOf(d, t, view)] = static_cast<float>(lit / (lit + other) - diffuse);
      }
    }
  }
  return table;
}

double surfaceAmbientAt(const SurfaceAmbient& table, double thickness, double depth,
                        double muView) {
  const SharePlace place = sharePlace(thickness, depth, muView);
  const double view = std::min(std::floor(place.view), double(VIEWS) - 2);
  const double low = std::min(std::floor(place.node.x), double(DEPTHS) - 2);
  const double row = std::min(std::floor(place.node.y), double(THICKNESSES) - 2);
  double sum = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const std::array<double, 3> part = {place.node.x - low, place.node.y - row, place.view - view};
    double weight = 1;
    for (unsigned k = 0; k < 3; ++k) {
      weight *= (corner >> k & 1U) != 0 ? part[k] : 1 - part[k];
    }
    sum +=
        weight *
        static_cast<double>(table.share[placeOf(
            static_cast<size_t>(low) + (corner & 1U), static_cast<size_t>(row) + (corner >> 1 & 1U),
            static_cast<size_t>(view) + (corner >> 2 & 1U) + (place.up ? VIEWS : 0))]);
  }
  return std::clamp(sum + place.diffuse, 0.0, 1.0);
}

}  // namespace welkin
