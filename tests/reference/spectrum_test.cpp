// SPDX-License-Identifier: MIT
#include "reference/spectrum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace welkin::reference {
namespace {

// What both sides of a published number with this many decimals may differ by.
constexpr double FOUR_DECIMALS = 0.5e-4;
constexpr double FIVE_DECIMALS = 0.5e-5;
// Chromaticity from sums over 10 nm instead of 1 nm: 1.2e-4 in the flat spectrum of equal energy,
// less in others.
constexpr double BIN_ERROR = 1.5e-4;

Spectrum same(double value) {
  Spectrum result{};
  result.fill(value);
  return result;
}

// Relative to its value at 560 nm; `second` is the second radiation constant over the temperature.
Spectrum planck(double second_nm) {
  Spectrum power{};
  for (size_t i = 0; i < SPECTRUM_BINS; ++i) {
    const double nm = SPECTRUM[i].wavelength_nm;
    power[i] = std::pow(560 / nm, 5) * std::expm1(second_nm / 560) / std::expm1(second_nm / nm);
  }
  return power;
}

TEST(Spectrum, EqualEnergyIsWhiteInXyz) {
  const Xyz xyz = xyzOf(same(1));
  // CIE 15: the sum of y over 1 nm.
  EXPECT_NEAR(xyz[1], 106.857, 1e-3 * 106.857);
  EXPECT_NEAR(chromaticityOf(xyz)[0], 1.0 / 3, BIN_ERROR);
  EXPECT_NEAR(chromaticityOf(xyz)[1], 1.0 / 3, BIN_ERROR);
}

// CIE 15: illuminant A is this formula, and its chromaticity stands there.
TEST(Spectrum, IlluminantAHasItsChromaticity) {
  const auto xy = chromaticityOf(xyzOf(planck(1.435e7 / 2848)));
  EXPECT_NEAR(xy[0], 0.44758, BIN_ERROR + FIVE_DECIMALS);
  EXPECT_NEAR(xy[1], 0.40745, BIN_ERROR + FIVE_DECIMALS);
}

// Among published values of the illuminance outside the atmosphere (128 to 134 klx) and of the
// correlated colour temperature (5800 to 6000 K), whose black bodies bound the chromaticity.
TEST(Spectrum, SunHasItsColorAndIlluminance) {
  Spectrum sun{};
  std::transform(SPECTRUM.begin(), SPECTRUM.end(), sun.begin(),
                 [](const SpectralBin& bin) { return bin.sun; });
  const Xyz xyz = xyzOf(sun);
  EXPECT_GT(683 * xyz[1], 128e3);
  EXPECT_LT(683 * xyz[1], 134e3);
  const auto xy = chromaticityOf(xyz);
  const auto warm = chromaticityOf(xyzOf(planck(1.4388e7 / 5800)));
  const auto cold = chromaticityOf(xyzOf(planck(1.4388e7 / 6000)));
  EXPECT_LT(xy[0], warm[0]);
  EXPECT_GT(xy[0], cold[0]);
  const Xyz one = sunlightOf(same(1));
  EXPECT_NEAR(one[1], 1, 1e-12);
  EXPECT_NEAR(one[0] / one[1], xyz[0] / xyz[1], 1e-12);
}

// Bucholtz 1995, Rayleigh-scattering calculations for the terrestrial atmosphere, Eq. 8: an
// independent fit of the same quantity, within 0.3 % by Bodhaine et al. 1999.
TEST(Spectrum, RayleighScatteringIsThatOfOtherAuthors) {
  for (const SpectralBin& bin : SPECTRUM) {
    const double um = 1e-3 * bin.wavelength_nm;
    const double other =
        um < 0.5 ? 3.01577e-32 * std::pow(um, -(3.55212 + 1.35579 * um + 0.11563 / um))
                 : 4.01061e-32 * std::pow(um, -(3.99668 + 1.10298e-3 * um + 2.71393e-2 / um));
    EXPECT_NEAR(rayleighCrossSection(bin.wavelength_nm), other, 3e-3 * other) << bin.wavelength_nm;
  }
}

// Chappuis band: largest near 603 nm, 5.1e-25 m^2 (Brion et al. 1998: 5.2e-25 at 295 K); next to
// nothing below 400 nm.
TEST(Spectrum, OzoneAbsorbsOrange) {
  const auto most = std::max_element(
      SPECTRUM.begin(), SPECTRUM.end(),
      [](const SpectralBin& a, const SpectralBin& b) { return a.ozone < b.ozone; });
  EXPECT_NEAR(most->wavelength_nm, 603, SPECTRUM_STEP_nm / 2);
  EXPECT_NEAR(most->ozone, 5.1e-25, 0.1e-25);
  EXPECT_LT(SPECTRUM[1].ozone, 2e-3 * most->ozone);
}

// IEC 61966-2-1.
TEST(Spectrum, SrgbHasItsPrimariesAndItsWhite) {
  const Rgb white = linearSrgbOf({0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290});
  const double primaries[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(white[i], 1, 1e-9);
    Rgb one{};
    one[i] = 1;
    const Xyz xyz = xyzOfLinearSrgb(one);
    EXPECT_NEAR(chromaticityOf(xyz)[0], primaries[i][0], 1e-9);
    EXPECT_NEAR(chromaticityOf(xyz)[1], primaries[i][1], 1e-9);
    const Rgb back = linearSrgbOf(xyz);
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(back[c], one[c], 1e-9);
    }
  }
}

// D65 in u'v' and grey in L*a*b*, CIE 15.
TEST(Spectrum, WhiteIsWhereItBelongs) {
  const Xyz white = xyzOfLinearSrgb({1, 1, 1});
  EXPECT_NEAR(uniformChromaticityOf(white)[0], 0.1978, FOUR_DECIMALS);
  EXPECT_NEAR(uniformChromaticityOf(white)[1], 0.4683, FOUR_DECIMALS);
  const Lab grey = labOf({0.184187 * white[0], 0.184187 * white[1], 0.184187 * white[2]}, white);
  EXPECT_NEAR(grey[0], 50, 1e-4);
  EXPECT_NEAR(grey[1], 0, 1e-9);
  EXPECT_NEAR(grey[2], 0, 1e-9);
}

// Sharma, Wu and Dalal 2005, The CIEDE2000 color-difference formula, Table 1: pairs that tell apart
// the mistakes known of programs.
TEST(Spectrum, ColorDifferenceHasPublishedValues) {
  const double table[][7] = {{50, 2.6772, -79.7751, 50, 0, -82.7485, 2.0425},
                             {50, 2.8361, -74.0200, 50, 0, -82.7485, 3.4412},
                             {50, -1.3802, -84.2814, 50, 0, -82.7485, 1.0000},
                             {50, 0, 0, 50, -1, 2, 2.3669},
                             {50, 2.4900, -0.0010, 50, -2.4900, 0.0009, 7.1792},
                             {50, 2.4900, -0.0010, 50, -2.4900, 0.0011, 7.2195},
                             {50, 2.5, 0, 50, 0, -2.5, 4.3065},
                             {50, 2.5, 0, 73, 25, -18, 27.1492},
                             {50, 2.5, 0, 56, -27, -3, 31.9030},
                             {60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644},
                             {22.7233, 20.0904, -46.6940, 23.0331, 14.9730, -42.5619, 2.0373},
                             {2.0776, 0.0795, -1.1350, 0.9033, -0.0636, -0.5514, 0.9082}};
  for (const auto& row : table) {
    const Lab one{row[0], row[1], row[2]};
    const Lab other{row[3], row[4], row[5]};
    EXPECT_NEAR(colorDifference(one, other), row[6], FOUR_DECIMALS) << row[1] << " " << row[4];
    EXPECT_NEAR(colorDifference(other, one), row[6], FOUR_DECIMALS);
  }
}

}  // namespace
}  // namespace welkin::reference
