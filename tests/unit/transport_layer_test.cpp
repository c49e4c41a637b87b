// SPDX-License-Identifier: MIT
// src/frame/transport_layer: its directions are a quadrature of either side, and its terms give
// back light that is made of them.
#include "frame/transport_layer.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using welkin::TransportLayer;
namespace shared = welkin::interface_;

constexpr double EPS = 1e-12;       // some hundred operations in double
constexpr double EPS_FLOAT = 1e-5;  // 48 terms of rows up to 30, in float
constexpr size_t COUNT = TransportLayer::COUNT;

// A box that lies askew, thin along its second axis.
TransportLayer askew(const glm::dvec3& travel) {
  const glm::dmat3 box(glm::dvec3{3e4, 1e4, 0}, glm::dvec3{-100, 300, 40},
                       glm::dvec3{0, 4e3, -3e4});
  return welkin::transportLayer(box, 1, glm::normalize(travel));
}

double termOf(const glm::vec4* rows, const TransportLayer& layer,
              const std::array<double, COUNT>& light, int begin, size_t term) {
  double sum = 0;
  for (size_t d = 0; d < COUNT; ++d) {
    const glm::vec4& row = rows[static_cast<size_t>(begin) + 3 * d + term / 4];
    sum += layer.weight[d] * light[d] * static_cast<double>(row[static_cast<int>(term % 4)]);
  }
  return sum;
}

TEST(TransportLayer, HasAFrameAroundItsNormalAndTheLight) {
  const glm::dvec3 travel = glm::normalize(glm::dvec3{0.3, -0.8, 0.4});
  const TransportLayer layer = askew(travel);
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(glm::dot(layer.frame[i], layer.frame[k]), i == k ? 1 : 0, EPS);
    }
    EXPECT_NEAR(glm::dot(layer.frame[i], travel), layer.travel[static_cast<int>(i)], EPS);
  }
  EXPECT_NEAR(glm::dot(layer.frame[2], glm::dvec3(3e4, 1e4, 0)), 0, EPS * 3e4);
  EXPECT_NEAR(glm::dot(layer.frame[2], glm::dvec3(0, 4e3, -3e4)), 0, EPS * 3e4);
  EXPECT_GE(layer.travel.x, 0);
}

TEST(TransportLayer, StandsUnderALightOnItsNormal) {
  const TransportLayer layer = askew(askew({0, -1, 0}).frame[2]);
  EXPECT_NEAR(glm::length(layer.frame[0]), 1, EPS);
  EXPECT_NEAR(layer.travel.z, 1, EPS);
}

// Gauss's 4 points are exact to degree 7 on either side, 6 azimuths to degree 5.
TEST(TransportLayer, DirectionsIntegratePowersOfTheHeightOnEitherSide) {
  const TransportLayer layer = askew({0.3, -0.8, 0.4});
  for (const double side : {1.0, -1.0}) {
    for (int power = 0; power < 8; ++power) {
      double sum = 0;
      glm::dvec2 across(0);
      for (size_t d = 0; d < COUNT; ++d) {
        EXPECT_NEAR(glm::length(layer.local[d]), 1, EPS);
        const double z = layer.local[d].z * side;
        if (z > 0) {
          sum += layer.weight[d] * std::pow(z, power);
          across += layer.weight[d] * std::pow(z, power) * glm::dvec2(layer.local[d]);
        }
      }
      EXPECT_NEAR(sum, 0.5 / (power + 1), EPS) << power;
      EXPECT_NEAR(glm::length(across), 0, EPS) << power;
    }
  }
}

TEST(TransportLayer, TermsOfLightMadeOfThemAreGivenBack) {
  const TransportLayer layer = askew({0.3, -0.8, 0.4});
  std::array<double, COUNT> shape{};
  for (size_t d = 0; d < COUNT; ++d) {
    shape[d] = 2 + layer.local[d].x - 0.5 * layer.local[d].y + layer.local[d].z;
  }
  std::vector<glm::vec4> rows(size_t{10} * shared::TRANSPORT_DIRECTIONS + 1);
  welkin::fillLayerRows(layer, shape, rows.data());
  std::array<double, COUNT> plain{};
  std::array<double, COUNT> twice{};
  for (size_t d = 0; d < COUNT; ++d) {
    const size_t side = d / (COUNT / 2);
    plain[d] = 1.5 + static_cast<double>(d / TransportLayer::TURNS);
    plain[d] += side == 0 ? 0.25 * layer.local[d].x : -0.75 * layer.local[d].y;
    twice[d] = plain[d] * shape[d];
  }
  for (size_t term = 0; term < shared::FIRST_TERMS; ++term) {
    const size_t lateral[] = {8, 11};  // x of the first side, y of the other
    double expected = 1.5 + static_cast<double>(term);
    if (term >= TransportLayer::RINGS) {
      expected = term == lateral[0] ? 0.25 : term == lateral[1] ? -0.75 : 0;
    }
    EXPECT_NEAR(termOf(rows.data(), layer, plain, shared::FIRST_ROWS, term), expected,
                EPS_FLOAT * (1 + std::abs(expected)))
        << term;
  }
  // A ring's ratio takes part of x and y where the shape is not even: the sums stay.
  for (size_t ring = 0; ring < TransportLayer::RINGS; ++ring) {
    double light = 0;
    double through = 0;
    for (size_t d = ring * TransportLayer::TURNS; d < (ring + 1) * TransportLayer::TURNS; ++d) {
      light += twice[d];
      through += shape[d];
    }
    EXPECT_NEAR(termOf(rows.data(), layer, twice, shared::SECOND_ROWS, ring), light / through,
                EPS_FLOAT * (1 + light / through))
        << ring;
  }
}

}  // namespace
