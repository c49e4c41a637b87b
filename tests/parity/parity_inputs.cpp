// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "parity/parity.hpp"
#include "reference/phase_reference.hpp"

namespace parity {
namespace {

constexpr float EARTH = 6371000.0f;  // m
constexpr float INF = std::numeric_limits<float>::infinity();

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  float uniform(double lo, double hi) {
    return static_cast<float>(std::uniform_real_distribution<double>(lo, hi)(generator_));
  }
  // Even in ln x.
  float logarithmic(double lo, double hi) {
    return static_cast<float>(
        std::exp(std::uniform_real_distribution<double>(std::log(lo), std::log(hi))(generator_)));
  }
  std::array<double, 3> direction() {
    std::normal_distribution<double> normal;
    const double x = normal(generator_);
    const double y = normal(generator_);
    const double z = normal(generator_);
    const double length = std::sqrt(x * x + y * y + z * z);
    return {x / length, y / length, z / length};
  }
  bool coin() { return (generator_() & 1U) != 0; }

 private:
  std::mt19937 generator_;
};

void put(Row& row, size_t at, const std::array<double, 3>& v) {
  for (size_t i = 0; i < 3; ++i) {
    row[at + i] = static_cast<float>(v[i]);
  }
}

// A value of y = 1 - cos: ends, peak and bulk.
float anyY(Random& random, size_t i) {
  switch (i) {
    case 0:
      return 0.0f;
    case 1:
      return 2.0f;
    default:
      return random.coin() ? random.logarithmic(1e-14, 2.0) : random.uniform(0, 2);
  }
}

void boxRow(Random& random, size_t i, Row& row) {
  for (size_t k = 0; k < 3; ++k) {
    row[k] = random.uniform(-2, 2);
    row[8 + k] = 0.0f;
    row[12 + k] = 1.0f;
  }
  put(row, 4, random.direction());
  if (i % 4 == 0) {
    row[4 + i / 4 % 3] = i % 8 == 0 ? 0.0f : -0.0f;
  }
}

void phaseRow(Random& random, size_t i, Row& row) {
  row[0] = anyY(random, i);
  row[1] = random.uniform(-0.99, 0.999);
  row[2] = random.uniform(0, 0.95);
  row[3] = random.uniform(0, 40);
}

void fogPhaseRow(Random& random, size_t i, Row& row) {
  const reference::Fog fog(random.logarithmic(5, 50));
  const float parameters[6] = {static_cast<float>(fog.gHg),   static_cast<float>(1 - fog.gHg),
                               static_cast<float>(fog.gD),    static_cast<float>(1 - fog.gD),
                               static_cast<float>(fog.alpha), static_cast<float>(fog.weight)};
  std::copy_n(parameters, 6, row.begin() + 8);
  const std::array<double, 3> a = random.direction();
  const std::array<double, 3> other = random.direction();
  const double step = random.logarithmic(1e-7, 100);
  std::array<double, 3> b{};
  double length = 0;
  for (size_t k = 0; k < 3; ++k) {
    b[k] = a[k] + step * other[k];
    length += b[k] * b[k];
  }
  for (double& x : b) {
    x /= std::sqrt(length);
  }
  put(row, 0, a);
  put(row, 4, i == 0 ? a : b);
}

void slicesRow(Random& random, Row& row) {
  // Where light and view are perpendicular the axis flips, and rounding decides which way.
  std::array<double, 3> a{};
  std::array<double, 3> b{};
  double cosine = 0;
  do {
    a = random.direction();
    b = random.direction();
    cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  } while (std::abs(cosine) < 1e-4);
  put(row, 0, a);
  put(row, 4, b);
  row[8] = random.logarithmic(1e-6, 60);
}

void compositeRow(Random& random, size_t i, Row& row) {
  for (size_t k = 0; k < 7; ++k) {
    row[k] = random.logarithmic(1e-4, 1e4);
  }
  row[3] = random.uniform(0, 1);
  const float special[4] = {std::numeric_limits<float>::quiet_NaN(), INF, -INF, -3.0f};
  row[7] = i < 4 ? special[i] : random.logarithmic(1e-3, 1e6);
  row[8] = 65504.0f;
}

void chordRow(Random& random, size_t i, Row& row) {
  for (const size_t k : {size_t{0}, size_t{1}, size_t{2}, size_t{3}, size_t{4}}) {
    row[k] = i == k ? 0.0f : random.logarithmic(1e-6, 60);
  }
  row[5] = i == 0 ? 1.0f : random.uniform(0, 0.99);
  row[6] = random.uniform(0, 1);
  row[7] = random.uniform(-0.2, 1.2);
}

// Directions apart from the normal, where the azimuth is no matter of rounding.
void tangentSlabRow(Random& random, Row& row) {
  std::array<double, 3> normal{};
  for (const size_t at : {size_t{4}, size_t{8}}) {
    double cosine = 1;
    std::array<double, 3> direction{};
    while (std::abs(cosine) > 0.9) {
      normal = at == 4 ? random.direction() : normal;
      direction = random.direction();
      cosine = normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2];
    }
    put(row, at, direction);
  }
  put(row, 0, normal);
  row[3] = random.logarithmic(1e-3, 1e4);
  row[7] = row[3] * random.uniform(-0.1, 1.1);
}

void collectorRow(Random& random, size_t i, Row& row) {
  for (size_t k = 0; k < 4; ++k) {
    row[k] = random.uniform(-10, 10);
  }
  row[4] = i == 0 ? 0.0f : random.logarithmic(1e-2, 100);
  row[5] = random.logarithmic(1e-2, 10);
  row[6] = random.uniform(-10, 10);
  row[7] = i % 8 == 0 ? 0.0f : random.uniform(0.01, 1);
}

// Faces up to 60 degrees from the light, so that their cosines are not small differences.
void footprintRow(Random& random, size_t i, Row& row) {
  std::array<double, 3> light = random.direction();
  const auto towards = [&](double sign) {
    std::array<double, 3> face{};
    double cosine = -1;
    while (cosine < 0.5) {
      face = random.direction();
      cosine = sign * (face[0] * light[0] + face[1] * light[1] + face[2] * light[2]);
    }
    return face;
  };
  put(row, 0, towards(1));
  put(row, 4, towards(-1));
  put(row, 8, random.direction());
  put(row, 12, light);
  row[3] = i == 0 ? 0.0f : random.uniform(0.02, 0.98);
  row[7] = random.logarithmic(1e-3, 1e3) * row[3];
  row[11] = random.uniform(0, 1);
  row[16] = static_cast<float>(i % 8) + 0.5f;
  row[17] = random.uniform(-10, 10);
  row[18] = row[7] / std::max(row[3], 0.02f) * random.logarithmic(0.3, 3);
}

void sourceRow(Random& random, size_t i, Row& row) {
  row[0] = random.logarithmic(1e-3, 1e4);
  row[1] = row[0] * random.uniform(0, 1);
  row[2] = random.uniform(0.001, 1);
  row[3] = random.uniform(-1, 1);
  row[4] = random.uniform(0, 3.14159);
  row[5] = random.uniform(-20, 3);
  row[6] = random.uniform(-8, 3);
  row[7] = random.uniform(0, 1);
  row[16] = static_cast<float>(i % 8) + 0.5f;
}

// Air and fog of cases.glsl, and a ray from altitude with view and light directions as vectors, so
// that the three cosines belong together.
void airRow(Random& random, size_t i, Row& row) {
  row[0] = EARTH;
  row[1] = 5.8e-6f;
  row[2] = 1.35e-5f;
  row[3] = 3.31e-5f;
  row[4] = 8000.0f;
  row[5] = i % 3 == 0 ? 0.0f : random.logarithmic(1e-6, 1e-2);
  row[6] = random.uniform(-100, 500);
  row[7] = random.logarithmic(50, 3000);
  row[8] = 0.9f;
  row[9] = 0.95f;
  row[10] = 1.0f;
  row[11] = i % 2 == 0 ? 0.0f : 6.5e-7f;
  row[12] = i % 5 == 0 ? 2.0f : random.logarithmic(1, 3e4);
  const double view = i % 2 == 0 ? random.uniform(-1, 1) : random.uniform(-0.1, 0.1);
  const double sun = random.uniform(-0.02, 1);
  const double azimuth = random.uniform(0, 3.14159);
  row[13] = static_cast<float>(view);
  row[14] = static_cast<float>(sun);
  row[15] = static_cast<float>(view * sun +
                               std::sqrt((1 - view * view) * (1 - sun * sun)) * std::cos(azimuth));
  row[16] = i % 7 == 0 ? INF : random.logarithmic(10, 1e5);
}

Row makeRow(int which, Random& random, size_t i) {
  Row row{};
  switch (which) {
    case CASE_NUMERIC:
      row[0] = i == 0 ? 0.0f : random.logarithmic(1e-9, 75) * (random.coin() ? 1.0f : -1.0f);
      row[1] = random.uniform(-100, 100);
      row[2] = i == 0 ? 0.0f : random.logarithmic(1e-6, 1e6);
      break;
    case CASE_BOX:
      boxRow(random, i, row);
      break;
    case CASE_ALTITUDE:
    case CASE_GROUND:
      row[0] = i == 0 ? 0.0f : random.logarithmic(1e-2, 1e6);
      row[1] = random.coin() ? random.uniform(-1, 1) : random.uniform(-0.1, 0.1);
      row[2] = EARTH;
      row[3] = random.logarithmic(1, 1e6);
      break;
    case CASE_PHASE:
      phaseRow(random, i, row);
      break;
    case CASE_FOG_PARAMETERS:
      row[0] = random.logarithmic(4, 60);
      break;
    case CASE_FOG_PHASE:
      fogPhaseRow(random, i, row);
      break;
    case CASE_SAMPLE: {
      // The gap comes as its own number, rounded once.
      const double gap = random.coin() ? random.logarithmic(1e-4, 1) : random.uniform(1, 1.5);
      row[0] = static_cast<float>(1 - gap);
      row[1] = static_cast<float>(gap);
      row[2] = i == 0 ? 0.0f : random.uniform(0, 1);
      break;
    }
    case CASE_CURVE:
      row[0] = i == 0 ? 0.0f : random.uniform(0, 1);
      row[4] = random.uniform(0, 1);
      row[5] = row[4] + random.logarithmic(1e-3, 1);
      row[6] = random.logarithmic(1e-4, 1e3);
      row[7] = random.logarithmic(1e-4, 1e3);
      row[8] = row[4] + random.uniform(0, 1) * (row[5] - row[4]);
      row[9] = i == 0 ? 0.0f : random.uniform(0, 1);
      break;
    case CASE_SCATTERING_TABLE:
      row[0] = anyY(random, i);
      row[1] = i == 0 ? 0.0f : random.logarithmic(1e-5, 200);
      row[2] = random.uniform(0, 1);
      row[3] = random.uniform(0.5, 1);
      break;
    case CASE_CANONICAL:
      row[0] = random.logarithmic(1e-3, 1e4);
      row[1] = row[0] * random.uniform(0, 1);
      row[2] = random.uniform(-1, 1);
      row[3] = random.uniform(0, 1);
      row[4] = random.uniform(-30, 3);
      row[5] = random.logarithmic(1e-4, 10);
      row[6] = random.uniform(0.001, 1);
      break;
    case CASE_CHORD:
      chordRow(random, i, row);
      break;
    case CASE_TANGENT_SLAB:
      tangentSlabRow(random, row);
      break;
    case CASE_COLLECTOR:
      collectorRow(random, i, row);
      break;
    case CASE_FOOTPRINT:
      footprintRow(random, i, row);
      break;
    case CASE_SOURCE:
      sourceRow(random, i, row);
      break;
    case CASE_SLICES:
      slicesRow(random, row);
      break;
    case CASE_COMPOSITE:
      compositeRow(random, i, row);
      break;
    case CASE_SEGMENT:
      // Below 40, so that the cut at e^-46 is not what is compared.
      row[0] = random.logarithmic(1e-5, 40);
      row[1] = random.coin() ? row[0] : random.logarithmic(1e-5, 40);
      row[2] = i == 0 ? 0.0f : random.logarithmic(1e-6, 40);
      row[4] = random.logarithmic(1e-7, 1);
      row[5] = random.uniform(-39, 60);
      row[6] = random.logarithmic(1, 1e5);
      break;
    case CASE_FLAT_SEGMENT:
      row[0] = random.logarithmic(4e-12, 7e-4);
      row[1] = 1.25e-4f;
      row[2] = random.coin() ? random.uniform(-1, 1) : random.uniform(-1e-6, 1e-6);
      row[3] = i % 5 == 0 ? row[2] : random.uniform(-0.1, 1);
      row[4] = random.logarithmic(1, 1e6);
      break;
    case CASE_LIGHT:
      airRow(random, i, row);
      row[14] = random.uniform(-0.05, 1);
      row[17] = random.uniform(-0.02, 0.02);
      row[18] = 0.00465f;
      break;
    case CASE_AIR_DEPTH:
      airRow(random, i, row);
      break;
    default:
      airRow(random, i, row);
      row[17] = 0.06f;
      row[18] = 0.3f;
      row[19] = 0.00465f;
      break;
  }
  return row;
}

}  // namespace

std::vector<Row> inputs(int which, size_t count) {
  Random random(static_cast<unsigned>(17 + which));
  std::vector<Row> rows;
  rows.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    rows.push_back(makeRow(which, random, i));
  }
  return rows;
}

const char* caseName(int which) {
  constexpr const char* NAMES[CASE_COUNT] = {
      "Numeric",       "Box",         "Altitude",        "Ground",   "Phase",
      "FogParameters", "FogPhase",    "ScatteringTable", "Slices",   "Composite",
      "Segment",       "FlatSegment", "Light",           "AirDepth", "Air",
      "Sample",        "Curve",       "Canonical",       "Chord",    "TangentSlab",
      "Collector",     "Footprint",   "Source"};
  return NAMES[which];
}

}  // namespace parity
