// SPDX-License-Identifier: MIT
// FLIP: per-pixel visible difference, 0 to 1, no unit. The colour pipeline filters by the eye's
// contrast sensitivity and measures distances in Hunt-adjusted Lab; the feature pipeline looks for
// edges and points; a difference in features amplifies the one in colour. Rewritten: the filters
// are sums of separable ones, so that a pixel costs 300 and not 5000 multiplications.
#include "common/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/parallel.hpp"

namespace host {
namespace {

using Color = std::array<double, 3>;
using Matrix = std::array<Color, 3>;
using Plane = std::vector<float>;
using Taps = std::vector<float>;  // of an odd count, the middle one is the pixel's own

// Linear sRGB to CIE XYZ relative to the white of (1, 1, 1): the numerators of the exact fractions,
// each row then divided by its sum.
constexpr Matrix XYZ_FROM_RGB = [] {
  Matrix m = {{{10135552.0, 8788810.0, 4435075.0},
               {2613072.0, 8788810.0, 887015.0},
               {1425312.0, 8788810.0, 70074185.0}}};
  for (Color& row : m) {
    const double white = row[0] + row[1] + row[2];
    row = {row[0] / white, row[1] / white, row[2] / white};
  }
  return m;
}();

// Inverse by cofactors.
constexpr Matrix RGB_FROM_XYZ = [] {
  const Matrix& m = XYZ_FROM_RGB;
  Matrix inverse{};
  double determinant = 0.0;
  for (size_t i = 0; i < 3; ++i) {
    const size_t i1 = (i + 1) % 3;
    const size_t i2 = (i + 2) % 3;
    for (size_t j = 0; j < 3; ++j) {
      const size_t j1 = (j + 1) % 3;
      const size_t j2 = (j + 2) % 3;
      inverse[j][i] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
    }
    determinant += m[0][i] * inverse[i][0];
  }
  for (Color& row : inverse) {
    row = {row[0] / determinant, row[1] / determinant, row[2] / determinant};
  }
  return inverse;
}();

Color multiply(const Matrix& m, const Color& v) {
  Color product{};
  for (size_t i = 0; i < 3; ++i) {
    product[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  }
  return product;
}

// CIE 1976 L*, a*, b* of XYZ relative to white, with a* and b* scaled by L* / 100: what is dark
// looks less colourful (Hunt).
Color huntLab(const Color& xyz) {
  constexpr double EDGE = 6.0 / 29.0;
  const auto f = [](double t) {
    return t > EDGE * EDGE * EDGE ? std::cbrt(t) : t / (3.0 * EDGE * EDGE) + 4.0 / 29.0;
  };
  const double y = f(xyz[1]);
  const double lightness = 116.0 * y - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (f(xyz[0]) - y),
          0.01 * lightness * 200.0 * (y - f(xyz[2]))};
}

// HyAB distance: city block between lightness and colour, Euclidean within colour.
double distance(const Color& a, const Color& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// Maps a distance to [0, 1]: its power, of which the lower 40 % take up 95 % of the range.
double colorError(double hyab) {
  constexpr double POWER = 0.7;
  constexpr double KNEE_IN = 0.4;
  constexpr double KNEE_OUT = 0.95;
  // The two colours of the cube that are farthest apart.
  static const double LARGEST = std::pow(distance(huntLab(multiply(XYZ_FROM_RGB, {0.0, 1.0, 0.0})),
                                                  huntLab(multiply(XYZ_FROM_RGB, {0.0, 0.0, 1.0}))),
                                         POWER);
  const double x = std::pow(hyab, POWER) / LARGEST;
  const double error = x < KNEE_IN ? x * (KNEE_OUT / KNEE_IN)
                                   : KNEE_OUT + (x - KNEE_IN) / (1.0 - KNEE_IN) * (1.0 - KNEE_OUT);
  return std::min(error, 1.0);
}

// weight(i) for i in [-radius, radius]; the positive ones then sum to 1, and the negative to -1.
template <class Weight>
Taps makeTaps(int radius, const Weight& weight) {
  double positive = 0.0;
  double negative = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    (weight(i) > 0.0 ? positive : negative) += std::abs(weight(i));
  }
  Taps taps;
  for (int i = -radius; i <= radius; ++i) {
    const double w = weight(i);
    taps.push_back(static_cast<float>(w / (w > 0.0 ? positive : std::max(negative, 1e-300))));
  }
  return taps;
}

struct WeightedBlur {
  float weight;
  Taps taps;
};

struct Filters {
  std::vector<WeightedBlur> achromatic;
  std::vector<WeightedBlur> redGreen;
  std::vector<WeightedBlur> blueYellow;
  Taps smooth;
  Taps edge;
  Taps point;
};

// Contrast sensitivity: a sum of a sqrt(pi / b) exp(-pi^2 z^2 / b) over the terms {a, b}, with z in
// degrees, over the square where the widest of all has not died out, with integral 1.
std::vector<WeightedBlur> contrastFilter(double pixelsPerDegree,
                                         const std::vector<std::array<double, 2>>& terms) {
  constexpr double PI = std::numbers::pi;
  constexpr double WIDEST = 0.04;
  const int radius =
      static_cast<int>(std::ceil(3.0 * std::sqrt(WIDEST / (2.0 * PI * PI)) * pixelsPerDegree));
  std::vector<WeightedBlur> blurs;
  double total = 0.0;
  std::vector<double> integrals;
  for (const auto& [a, b] : terms) {
    const double scale = PI * PI / (b * pixelsPerDegree * pixelsPerDegree);
    const auto gauss = [scale](int i) { return std::exp(-scale * i * i); };
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) {
      sum += gauss(i);
    }
    integrals.push_back(a * std::sqrt(PI / b) * sum * sum);
    total += integrals.back();
    blurs.push_back({0.0f, makeTaps(radius, gauss)});
  }
  for (size_t i = 0; i < blurs.size(); ++i) {
    blurs[i].weight = static_cast<float>(integrals[i] / total);
  }
  return blurs;
}

Filters makeFilters(double pixelsPerDegree) {
  Filters filters;
  filters.achromatic = contrastFilter(pixelsPerDegree, {{1.0, 0.0047}});
  filters.redGreen = contrastFilter(pixelsPerDegree, {{1.0, 0.0053}});
  filters.blueYellow = contrastFilter(pixelsPerDegree, {{34.1, 0.04}, {13.5, 0.025}});
  // The eye's edge detector is 0.082 degrees wide from peak to trough: two standard deviations.
  const double deviation = 0.5 * 0.082 * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  const auto gauss = [=](int i) { return std::exp(-i * i / (2.0 * deviation * deviation)); };
  filters.smooth = makeTaps(radius, gauss);
  filters.edge = makeTaps(radius, [&](int i) { return -i * gauss(i); });
  filters.point =
      makeTaps(radius, [&](int i) { return (i * i / (deviation * deviation) - 1.0) * gauss(i); });
  return filters;
}

// One picture on its way: size and rows in parallel.
class Filtering {
 public:
  Filtering(uint32_t width, uint32_t height) : width_(width), height_(height) {}

  // Correlation along rows or columns; the border pixels go on for ever.
  [[nodiscard]] Plane alongRows(const Plane& in, const Taps& taps) const {
    Plane out(in.size(), 0.0f);
    const size_t radius = taps.size() / 2;
    parallelFor(height_, [&](uint32_t y) {
      const float* row = in.data() + size_t{y} * width_;
      Plane padded(width_ + 2 * radius);
      for (size_t i = 0; i < padded.size(); ++i) {
        padded[i] = row[std::clamp(i, radius, radius + width_ - 1) - radius];
      }
      for (size_t k = 0; k < taps.size(); ++k) {
        add(out.data() + size_t{y} * width_, padded.data() + k, taps[k]);
      }
    });
    return out;
  }
  [[nodiscard]] Plane alongColumns(const Plane& in, const Taps& taps) const {
    Plane out(in.size(), 0.0f);
    const size_t radius = taps.size() / 2;
    parallelFor(height_, [&](uint32_t y) {
      for (size_t k = 0; k < taps.size(); ++k) {
        const size_t row = std::clamp(y + k, radius, radius + height_ - 1) - radius;
        add(out.data() + size_t{y} * width_, in.data() + row * width_, taps[k]);
      }
    });
    return out;
  }
  [[nodiscard]] Plane blurred(const Plane& in, const std::vector<WeightedBlur>& blurs) const {
    Plane out(in.size(), 0.0f);
    for (const WeightedBlur& blur : blurs) {
      const Plane part = alongColumns(alongRows(in, blur.taps), blur.taps);
      for (size_t i = 0; i < out.size(); ++i) {
        out[i] += blur.weight * part[i];
      }
    }
    return out;
  }
  // Magnitude of the responses to `derivative` across and down, each smoothed the other way.
  [[nodiscard]] Plane features(const Plane& in, const Taps& smooth, const Taps& derivative) const {
    Plane across = alongRows(alongColumns(in, smooth), derivative);
    const Plane down = alongColumns(alongRows(in, smooth), derivative);
    for (size_t i = 0; i < across.size(); ++i) {
      across[i] = std::sqrt(across[i] * across[i] + down[i] * down[i]);
    }
    return across;
  }

 private:
  void add(float* out, const float* in, float factor) const {
    for (uint32_t x = 0; x < width_; ++x) {
      out[x] += factor * in[x];
    }
  }

  uint32_t width_;
  uint32_t height_;
};

// What of a picture reaches the comparison.
struct Percept {
  std::vector<Color> color;
  Plane edge;
  Plane point;
};

Percept perceive(const Image& image, const Filters& filters) {
  const size_t count = image.pixelCount();
  // Y, Cx and Cz without their factors 116, 500, 200 and offset: filters of integral 1 keep both.
  std::array<Plane, 3> opponent = {Plane(count), Plane(count), Plane(count)};
  parallelFor(image.height, [&](uint32_t row) {
    for (size_t i = size_t{row} * image.width; i < (size_t{row} + 1) * image.width; ++i) {
      const float* rgb = image.rgba.data() + 4 * i;
      const Color xyz = multiply(XYZ_FROM_RGB, {double{rgb[0]}, double{rgb[1]}, double{rgb[2]}});
      opponent[0][i] = static_cast<float>(xyz[1]);
      opponent[1][i] = static_cast<float>(xyz[0] - xyz[1]);
      opponent[2][i] = static_cast<float>(xyz[1] - xyz[2]);
    }
  });
  const Filtering filtering(image.width, image.height);
  Percept percept;
  percept.edge = filtering.features(opponent[0], filters.smooth, filters.edge);
  percept.point = filtering.features(opponent[0], filters.smooth, filters.point);
  opponent[0] = filtering.blurred(opponent[0], filters.achromatic);
  opponent[1] = filtering.blurred(opponent[1], filters.redGreen);
  opponent[2] = filtering.blurred(opponent[2], filters.blueYellow);
  percept.color.resize(count);
  parallelFor(image.height, [&](uint32_t row) {
    for (size_t i = size_t{row} * image.width; i < (size_t{row} + 1) * image.width; ++i) {
      const double y = double{opponent[0][i]};
      Color rgb =
          multiply(RGB_FROM_XYZ, {y + double{opponent[1][i]}, y, y - double{opponent[2][i]}});
      for (double& channel : rgb) {
        channel = std::clamp(channel, 0.0, 1.0);  // what the display can show
      }
      percept.color[i] = huntLab(multiply(XYZ_FROM_RGB, rgb));
    }
  });
  return percept;
}

std::vector<float> difference(const Image& a, const Image& b, const Filters& filters) {
  const Percept perceptA = perceive(a, filters);
  const Percept perceptB = perceive(b, filters);
  std::vector<float> map(a.pixelCount());
  parallelFor(a.height, [&](uint32_t row) {
    for (size_t i = size_t{row} * a.width; i < (size_t{row} + 1) * a.width; ++i) {
      const double color = colorError(distance(perceptA.color[i], perceptB.color[i]));
      const float feature = std::max(std::abs(perceptA.edge[i] - perceptB.edge[i]),
                                     std::abs(perceptA.point[i] - perceptB.point[i]));
      const double featureError = std::sqrt(double{feature} / std::numbers::sqrt2);
      map[i] = static_cast<float>(std::pow(color, 1.0 - std::min(featureError, 1.0)));
    }
  });
  return map;
}

}  // namespace

std::vector<float> ldrFlip(const Image& picture, const Image& reference, double pixelsPerDegree) {
  return difference(picture, reference, makeFilters(pixelsPerDegree));
}

}  // namespace host
