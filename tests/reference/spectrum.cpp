// SPDX-License-Identifier: MIT
// Colour matching: CIE 1931 at the bins' centres. Sun: ASTM G-173 (Gueymard 2004), the column
// outside the atmosphere, mean of each bin. Ozone: Gorshelev et al. 2014 and Serdyuchenko et al.
// 2014, High spectral resolution ozone absorption cross-sections, at 233 K, mean of each bin.
// Both means as published with Bruneton 2017, A qualitative and quantitative evaluation of 8 clear
// sky models.
#include "reference/spectrum.hpp"

#include <cmath>
#include <numbers>

namespace welkin::reference {

// clang-format off
const std::array<SpectralBin, SPECTRUM_BINS> SPECTRUM = {{
    {385, 0.002236, 6.4e-05, 0.01055, 1.01249, 2.818e-28},
    {395, 0.00765, 0.000217, 0.03621, 1.14716, 6.636e-28},
    {405, 0.02319, 0.00064, 0.1102, 1.72765, 1.527e-27},
    {415, 0.07763, 0.00218, 0.3713, 1.73054, 2.763e-27},
    {425, 0.21477, 0.0073, 1.03905, 1.6887, 5.52e-27},
    {435, 0.3285, 0.01684, 1.62296, 1.61253, 8.451e-27},
    {445, 0.34806, 0.0298, 1.7826, 1.91198, 1.582e-26},
    {455, 0.3187, 0.048, 1.7441, 2.03474, 2.316e-26},
    {465, 0.2511, 0.0739, 1.5281, 2.02042, 3.669e-26},
    {475, 0.1421, 0.1126, 1.0419, 2.02212, 4.924e-26},
    {485, 0.05795, 0.1693, 0.6162, 1.93377, 7.752e-26},
    {495, 0.0147, 0.2586, 0.3533, 1.95809, 9.016e-26},
    {505, 0.0024, 0.4073, 0.2123, 1.91686, 1.48e-25},
    {515, 0.0291, 0.6082, 0.1117, 1.8298, 1.602e-25},
    {525, 0.1096, 0.7932, 0.05725, 1.8685, 2.139e-25},
    {535, 0.22575, 0.91485, 0.02984, 1.8931, 2.755e-25},
    {545, 0.3597, 0.9803, 0.0134, 1.85149, 3.091e-25},
    {555, 0.51205, 1, 0.00575, 1.8504, 3.5e-25},
    {565, 0.6784, 0.9786, 0.00275, 1.8341, 4.266e-25},
    {575, 0.8425, 0.9154, 0.0018, 1.8345, 4.672e-25},
    {585, 0.9786, 0.8163, 0.0014, 1.8147, 4.398e-25},
    {595, 1.0567, 0.6949, 0.001, 1.78158, 4.701e-25},
    {605, 1.0456, 0.5668, 0.0006, 1.7533, 5.019e-25},
    {615, 0.9384, 0.4412, 0.00024, 1.6965, 4.305e-25},
    {625, 0.7514, 0.321, 0.0001, 1.68194, 3.74e-25},
    {635, 0.5419, 0.217, 3e-05, 1.64654, 3.215e-25},
    {645, 0.3608, 0.1382, 1e-05, 1.6048, 2.662e-25},
    {655, 0.2187, 0.0816, 0, 1.52143, 2.238e-25},
    {665, 0.1212, 0.04458, 0, 1.55622, 1.852e-25},
    {675, 0.0636, 0.0232, 0, 1.5113, 1.473e-25},
    {685, 0.0329, 0.01192, 0, 1.474, 1.209e-25},
    {695, 0.01584, 0.005723, 0, 1.4482, 9.423e-26},
    {705, 0.00811092, 0.002929, 0, 1.41018, 7.455e-26},
    {715, 0.00410946, 0.001484, 0, 1.36775, 6.566e-26},
    {725, 0.00204919, 0.00074, 0, 1.34188, 5.105e-26},
    {735, 0.000999949, 0.0003611, 0, 1.31429, 4.15e-26},
    {745, 0.000476021, 0.0001719, 0, 1.28303, 4.228e-26},
    {755, 0.000234826, 8.48e-05, 0, 1.26758, 3.237e-26},
    {765, 0.000117413, 4.24e-05, 0, 1.2367, 2.451e-26},
    {775, 5.87065e-05, 2.12e-05, 0, 1.2082, 2.801e-26},
}};
// clang-format on

double rayleighCrossSection(double wavelength_nm) {
  const double um = 1e-3 * wavelength_nm;
  const double square = um * um;
  return 1e-32 * (1.0455996 - 341.29061 / square - 0.90230850 * square) /
         (1 + 0.0027059889 / square - 85.968563 * square);
}

Xyz xyzOf(const Spectrum& power) {
  Xyz sum{};
  for (size_t i = 0; i < SPECTRUM_BINS; ++i) {
    const SpectralBin& bin = SPECTRUM[i];
    sum[0] += SPECTRUM_STEP_nm * power[i] * bin.x;
    sum[1] += SPECTRUM_STEP_nm * power[i] * bin.y;
    sum[2] += SPECTRUM_STEP_nm * power[i] * bin.z;
  }
  return sum;
}

Xyz sunlightOf(const Spectrum& share) {
  Spectrum power;
  double whole = 0;
  for (size_t i = 0; i < SPECTRUM_BINS; ++i) {
    power[i] = share[i] * SPECTRUM[i].sun;
    whole += SPECTRUM_STEP_nm * SPECTRUM[i].sun * SPECTRUM[i].y;
  }
  Xyz result = xyzOf(power);
  for (double& value : result) {
    value /= whole;
  }
  return result;
}

namespace {

// The inverse of each other; from the primaries' and the white's chromaticities.
constexpr double TO_SRGB[3][3] = {{3.2409699419045226, -1.5373831775700939, -0.4986107602930034},
                                  {-0.9692436362808796, 1.8759675015077202, 0.0415550574071756},
                                  {0.0556300796969936, -0.2039769588889765, 1.0569715142428786}};
constexpr double FROM_SRGB[3][3] = {{0.4123907992659595, 0.3575843393838780, 0.1804807884018343},
                                    {0.2126390058715104, 0.7151686787677559, 0.0721923153607337},
                                    {0.0193308187155918, 0.1191947797946259, 0.9505321522496607}};

std::array<double, 3> product(const double (&matrix)[3][3], const std::array<double, 3>& v) {
  std::array<double, 3> result{};
  for (size_t i = 0; i < 3; ++i) {
    result[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
  }
  return result;
}

constexpr double DEGREE = std::numbers::pi / 180;

// 0 to 360 degrees.
double hueOf(double a, double b) {
  const double hue = std::atan2(b, a) / DEGREE;
  return hue < 0 ? hue + 360 : hue;
}

double cosine(double degrees) {
  return std::cos(degrees * DEGREE);
}

}  // namespace

Rgb linearSrgbOf(const Xyz& xyz) {
  return product(TO_SRGB, xyz);
}

Xyz xyzOfLinearSrgb(const Rgb& rgb) {
  return product(FROM_SRGB, rgb);
}

std::array<double, 2> chromaticityOf(const Xyz& xyz) {
  const double sum = xyz[0] + xyz[1] + xyz[2];
  return {xyz[0] / sum, xyz[1] / sum};
}

std::array<double, 2> uniformChromaticityOf(const Xyz& xyz) {
  const double sum = xyz[0] + 15 * xyz[1] + 3 * xyz[2];
  return {4 * xyz[0] / sum, 9 * xyz[1] / sum};
}

Lab labOf(const Xyz& xyz, const Xyz& white) {
  double f[3];
  for (size_t i = 0; i < 3; ++i) {
    constexpr double EDGE = 6.0 / 29;
    const double share = xyz[i] / white[i];
    f[i] = share > EDGE * EDGE * EDGE ? std::cbrt(share) : share / (3 * EDGE * EDGE) + 4.0 / 29;
  }
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

double colorDifference(const Lab& one, const Lab& other) {
  const auto seventh = [](double chroma) {
    const double power = std::pow(chroma, 7);
    return std::sqrt(power / (power + std::pow(25.0, 7)));
  };
  const double meanAb = (std::hypot(one[1], one[2]) + std::hypot(other[1], other[2])) / 2;
  const double stretch = 1.5 - 0.5 * seventh(meanAb);
  const double a1 = stretch * one[1];
  const double a2 = stretch * other[1];
  const double c1 = std::hypot(a1, one[2]);
  const double c2 = std::hypot(a2, other[2]);
  const double h1 = hueOf(a1, one[2]);
  const double h2 = hueOf(a2, other[2]);
  const bool grey = c1 * c2 == 0;
  double turn = grey ? 0 : h2 - h1;
  double hue = grey ? h1 + h2 : (h1 + h2) / 2;
  if (std::abs(turn) > 180) {
    turn -= std::copysign(360, turn);
    hue += h1 + h2 < 360 ? 180 : -180;
  }
  const double light = (one[0] + other[0]) / 2 - 50;
  const double chroma = (c1 + c2) / 2;
  const double t = 1 - 0.17 * cosine(hue - 30) + 0.24 * cosine(2 * hue) +
                   0.32 * cosine(3 * hue + 6) - 0.20 * cosine(4 * hue - 63);
  const double dl =
      (other[0] - one[0]) / (1 + 0.015 * light * light / std::sqrt(20 + light * light));
  const double dc = (c2 - c1) / (1 + 0.045 * chroma);
  const double dh = 2 * std::sqrt(c1 * c2) * std::sin(turn / 2 * DEGREE) / (1 + 0.015 * chroma * t);
  const double blue = (hue - 275) / 25;
  const double rotation = -2 * seventh(chroma) * std::sin(60 * DEGREE * std::exp(-blue * blue));
  return std::sqrt(dl * dl + dc * dc + dh * dh + rotation * dc * dh);
}

}  // namespace welkin::reference
