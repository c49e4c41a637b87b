// SPDX-License-Identifier: MIT
// FLIP once more (0 to 1, no unit) by the papers' formulas, for small pictures: doubles, each
// filter a full square of taps, color from the chromaticities of sRGB.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/image.hpp"

namespace host_test {

inline constexpr double PI = 3.14159265358979323846;
using Vec = std::array<double, 3>;

// Tristimulus values relative to D65, from the chromaticities of IEC 61966-2-1: each primary's
// (x/y, 1, z/y) times the luminance that makes the three add up to white.
inline Vec xyzOf(const Vec& rgb) {
  const std::array<std::array<double, 2>, 3> primaries = {
      {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}};
  const std::array<double, 2> white = {0.3127, 0.3290};
  const auto column = [](const std::array<double, 2>& xy) -> Vec {
    return {xy[0] / xy[1], 1.0, (1.0 - xy[0] - xy[1]) / xy[1]};
  };
  const Vec r = column(primaries[0]);
  const Vec g = column(primaries[1]);
  const Vec b = column(primaries[2]);
  const Vec w = column(white);
  const auto det = [](const Vec& x, const Vec& y, const Vec& z) {
    return x[0] * (y[1] * z[2] - y[2] * z[1]) - y[0] * (x[1] * z[2] - x[2] * z[1]) +
           z[0] * (x[1] * y[2] - x[2] * y[1]);
  };
  const double all = det(r, g, b);
  const Vec luminance = {det(w, g, b) / all, det(r, w, b) / all, det(r, g, w) / all};
  Vec xyz{};
  for (size_t i = 0; i < 3; ++i) {
    xyz[i] = (rgb[0] * luminance[0] * r[i] + rgb[1] * luminance[1] * g[i] +
              rgb[2] * luminance[2] * b[i]) /
             w[i];
  }
  return xyz;
}

// L*, a*, b*, the latter two times L* / 100.
inline Vec labOf(const Vec& rgb) {
  const Vec xyz = xyzOf(rgb);
  Vec f{};
  for (size_t i = 0; i < 3; ++i) {
    f[i] = xyz[i] > 216.0 / 24389.0 ? std::pow(xyz[i], 1.0 / 3.0)
                                    : (24389.0 / 27.0 * xyz[i] + 16.0) / 116.0;
  }
  const double l = 116.0 * f[1] - 16.0;
  return {l, 500.0 * (f[0] - f[1]) * l / 100.0, 200.0 * (f[1] - f[2]) * l / 100.0};
}

inline double hyab(const Vec& a, const Vec& b) {
  return std::abs(a[0] - b[0]) +
         std::sqrt((a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

// FLIP of two uniform pictures: no features, no filter.
inline double uniformFlip(const Vec& a, const Vec& b) {
  const double largest = std::pow(hyab(labOf({0, 1, 0}), labOf({0, 0, 1})), 0.7);
  const double error = std::pow(hyab(labOf(a), labOf(b)), 0.7);
  const double knee = 0.4 * largest;
  return error < knee ? 0.95 * error / knee : 0.95 + 0.05 * (error - knee) / (largest - knee);
}

struct Direct {
  int width, height;
  std::vector<Vec> color;
  std::vector<double> edge, point;
};

// Both pipelines up to the comparison, each filter a square of taps.
inline Direct perceive(const host::Image& image, double pixelsPerDegree) {
  Direct d{static_cast<int>(image.width), static_cast<int>(image.height), {}, {}, {}};
  std::vector<Vec> opponent;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const float* p = image.rgba.data() + 4 * i;
    const Vec xyz = xyzOf({double{p[0]}, double{p[1]}, double{p[2]}});
    opponent.push_back(
        {116.0 * xyz[1] - 16.0, 500.0 * (xyz[0] - xyz[1]), 200.0 * (xyz[1] - xyz[2])});
  }
  const auto at = [&](int x, int y) -> const Vec& {
    return opponent[static_cast<size_t>(std::clamp(y, 0, d.height - 1)) * image.width +
                    static_cast<size_t>(std::clamp(x, 0, d.width - 1))];
  };
  const auto csf = [&](double a, double b, double z) {
    return a * std::sqrt(PI / b) * std::exp(-PI * PI * z / b);
  };
  const int r =
      static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * PI * PI)) * pixelsPerDegree));
  const double s = 0.5 * 0.082 * pixelsPerDegree;
  const int rf = static_cast<int>(std::ceil(3.0 * s));
  const Vec toRed = xyzOf({1, 0, 0});
  const Vec toGreen = xyzOf({0, 1, 0});
  const Vec toBlue = xyzOf({0, 0, 1});
  for (int y = 0; y < d.height; ++y) {
    for (int x = 0; x < d.width; ++x) {
      Vec sum{};
      Vec total{};
      for (int j = -r; j <= r; ++j) {
        for (int i = -r; i <= r; ++i) {
          const double z = (i * i + j * j) / (pixelsPerDegree * pixelsPerDegree);
          const Vec w = {csf(1.0, 0.0047, z), csf(1.0, 0.0053, z),
                         csf(34.1, 0.04, z) + csf(13.5, 0.025, z)};
          for (size_t c = 0; c < 3; ++c) {
            sum[c] += w[c] * at(x + i, y + j)[c];
            total[c] += w[c];
          }
        }
      }
      const double py = (sum[0] / total[0] + 16.0) / 116.0;
      const Vec xyz = {py + sum[1] / total[1] / 500.0, py, py - sum[2] / total[2] / 200.0};
      // Back to RGB by Cramer's rule.
      const auto det = [](const Vec& a, const Vec& b, const Vec& c) {
        return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
               c[0] * (a[1] * b[2] - a[2] * b[1]);
      };
      const double all = det(toRed, toGreen, toBlue);
      d.color.push_back(labOf({std::clamp(det(xyz, toGreen, toBlue) / all, 0.0, 1.0),
                               std::clamp(det(toRed, xyz, toBlue) / all, 0.0, 1.0),
                               std::clamp(det(toRed, toGreen, xyz) / all, 0.0, 1.0)}));
      // Responses [edge, point][across, down] of the positive and the negative weights.
      double response[2][2][2] = {};
      double weight[2][2][2] = {};
      for (int j = -rf; j <= rf; ++j) {
        for (int i = -rf; i <= rf; ++i) {
          const double g = std::exp(-(i * i + j * j) / (2.0 * s * s));
          const double value = (at(x + i, y + j)[0] + 16.0) / 116.0;
          const double kernels[2][2] = {{-i * g, -j * g},
                                        {(i * i / (s * s) - 1.0) * g, (j * j / (s * s) - 1.0) * g}};
          for (int k = 0; k < 2; ++k) {
            for (int axis = 0; axis < 2; ++axis) {
              const double w = kernels[k][axis];
              response[k][axis][w > 0.0] += std::abs(w) * value;
              weight[k][axis][w > 0.0] += std::abs(w);
            }
          }
        }
      }
      const auto magnitude = [&](int k) {
        double square = 0.0;
        for (int axis = 0; axis < 2; ++axis) {
          const double v =
              response[k][axis][1] / weight[k][axis][1] - response[k][axis][0] / weight[k][axis][0];
          square += v * v;
        }
        return std::sqrt(square);
      };
      d.edge.push_back(magnitude(0));
      d.point.push_back(magnitude(1));
    }
  }
  return d;
}

inline std::vector<double> directFlip(const host::Image& a, const host::Image& b,
                                      double pixelsPerDegree) {
  const Direct da = perceive(a, pixelsPerDegree);
  const Direct db = perceive(b, pixelsPerDegree);
  const double largest = std::pow(hyab(labOf({0, 1, 0}), labOf({0, 0, 1})), 0.7);
  std::vector<double> map;
  for (size_t i = 0; i < a.pixelCount(); ++i) {
    const double e = std::pow(hyab(da.color[i], db.color[i]), 0.7) / largest;
    const double color = e < 0.4 ? e * 0.95 / 0.4 : 0.95 + (e - 0.4) / 0.6 * 0.05;
    const double feature =
        std::max(std::abs(da.edge[i] - db.edge[i]), std::abs(da.point[i] - db.point[i]));
    map.push_back(std::pow(color, 1.0 - std::sqrt(feature / std::sqrt(2.0))));
  }
  return map;
}

}  // namespace host_test
