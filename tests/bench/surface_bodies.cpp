// SPDX-License-Identifier: MIT
// The bodies of surface_views.hpp: a stratocumulus (a sheet between two bumpy heights that meet at
// its rim) and a cumulus (a field polygonised by tetrahedra). Kept apart from the sample host's
// clouds: these are the truth's.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "bench/surface_views.hpp"
#include "common/noise.hpp"

namespace bench {
namespace {

using host::Vec3;

void addPosition(BodyMesh& mesh, const Vec3& p) {
  for (const double x : {p.x, p.y, p.z}) {
    mesh.positions.push_back(static_cast<float>(x));
  }
}

// Round bumps with creases between them, in about [0, 1].
double billows(Vec3 p, uint32_t seed) {
  double sum = 0;
  double weight = 0.6;
  for (uint32_t octave = 0; octave < 3; ++octave) {
    sum += weight * (1 - std::fabs(host::perlin(p, seed + octave)));
    p = p * 2.1;
    weight *= 0.45;
  }
  return sum;
}

// 2 km wide, 200 m thick in the middle, by latitudes and longitudes of the two faces.
BodyMesh stratocumulus() {
  constexpr uint32_t N = 72;
  constexpr double HALF = 1000;          // m
  constexpr double ABOVE = 330;          // m
  constexpr double BELOW = 50;           // m
  constexpr double ALTITUDE = 800;       // m
  constexpr double BUMP = 330;           // m
  const auto placeOf = [](uint32_t i) {  // finer at the rim
    return std::sin(std::numbers::pi * (static_cast<double>(i) / N - 0.5));
  };
  BodyMesh mesh;
  std::map<std::pair<uint32_t, bool>, uint32_t> index;
  for (const bool top : {true, false}) {
    for (uint32_t k = 0; k < (N + 1) * (N + 1); ++k) {
      const uint32_t i = k % (N + 1);
      const uint32_t j = k / (N + 1);
      if (i == 0 || j == 0 || i == N || j == N) {
        if (!top) {  // the rim is shared
          index[{k, top}] = index[{k, true}];
          continue;
        }
      }
      const double u = placeOf(i);
      const double v = placeOf(j);
      const double rim = std::sqrt(std::max((1 - std::pow(u, 8)) * (1 - std::pow(v, 8)), 0.0));
      const Vec3 p{HALF * u, 0, HALF * v};
      const double bump = billows(p * (1 / BUMP), top ? 3 : 17);
      const double height = top ? ABOVE * rim * (0.15 + 0.85 * bump * bump * bump * bump)
                                : -BELOW * rim * (0.7 + 0.3 * bump);
      index[{k, top}] = static_cast<uint32_t>(mesh.positions.size() / 3);
      addPosition(mesh, p + Vec3{0, ALTITUDE + height, 0});
    }
  }
  for (const bool top : {true, false}) {
    for (uint32_t j = 0; j < N; ++j) {
      for (uint32_t i = 0; i < N; ++i) {
        const uint32_t k = j * (N + 1) + i;
        const uint32_t a = index[{k, top}];
        const uint32_t b = index[{k + 1, top}];
        const uint32_t c = index[{k + N + 1, top}];
        const uint32_t d = index[{k + N + 2, top}];
        if (top) {
          mesh.indices.insert(mesh.indices.end(), {a, c, d, a, d, b});
        } else {
          mesh.indices.insert(mesh.indices.end(), {a, d, c, a, b, d});
        }
      }
    }
  }
  return mesh;
}

// Balls on a base, blended, with billows: > 0 inside, m.
double cumulusAt(const Vec3& p) {
  constexpr double BLEND = 40;  // m
  constexpr double DEEP = 60;   // m, of the billows
  struct Ball {
    Vec3 middle;
    double radius;
  };
  static constexpr Ball BALLS[] = {
      {{0, 1050, 0}, 430},     {{-80, 1420, 60}, 330},  {{90, 1730, -30}, 230},
      {{-480, 950, 120}, 290}, {{450, 980, -140}, 320}, {{430, 1290, -60}, 190},
      {{-120, 960, 430}, 270}, {{160, 940, 400}, 240},  {{120, 930, -450}, 280},
      {{-420, 1190, 40}, 170}, {{-60, 1930, 10}, 140}};
  double sum = 0;
  for (const Ball& ball : BALLS) {
    sum += std::exp((ball.radius - host::length(p - ball.middle)) / BLEND);
  }
  const double inside = BLEND * std::log(sum) + DEEP * (billows(p * (1 / 170.0), 5) - 0.8);
  // A flat base, rounded.
  const double above = p.y - 800;
  return -BLEND / 4 * std::log(std::exp(-4 * inside / BLEND) + std::exp(-4 * above / BLEND));
}

// Cubes of `cellEdge` m, each in six tetrahedra around its diagonal; triangles face outwards.
template <uint32_t N>
BodyMesh cumulus(double cellEdge) {
  const Vec3 low{-890, 720, -880};
  std::vector<double> field;
  const auto pointAt = [&](uint32_t i) {
    return low + Vec3{cellEdge * (i % N), cellEdge * (i / N % N), cellEdge * (i / N / N)};
  };
  for (uint32_t i = 0; i < N * N * N; ++i) {
    field.push_back(cumulusAt(pointAt(i)));
  }
  BodyMesh mesh;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> made;
  std::vector<Vec3> positions;
  const auto cut = [&](uint32_t a, uint32_t b) {
    const auto [found, fresh] =
        made.try_emplace(std::minmax(a, b), static_cast<uint32_t>(positions.size()));
    if (fresh) {
      const auto [x, y] = std::minmax(a, b);
      // Not at the lattice's points, where triangles would shrink to nothing.
      const double part = std::clamp(field[x] / (field[x] - field[y]), 0.02, 0.98);
      positions.push_back(pointAt(x) + (pointAt(y) - pointAt(x)) * part);
    }
    return found->second;
  };
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c, const Vec3& outwards) {
    const Vec3 normal = host::cross(positions[b] - positions[a], positions[c] - positions[a]);
    const bool turn = host::dot(normal, outwards) < 0;
    mesh.indices.insert(mesh.indices.end(), {a, turn ? c : b, turn ? b : c});
  };
  constexpr uint32_t AXES[6][3] = {{1, N, N * N}, {1, N * N, N}, {N, 1, N * N},
                                   {N, N * N, 1}, {N * N, 1, N}, {N * N, N, 1}};
  for (uint32_t cell = 0; cell < N * N * N; ++cell) {
    if (cell % N == N - 1 || cell / N % N == N - 1 || cell / N / N == N - 1) {
      continue;
    }
    for (const auto& axes : AXES) {
      const uint32_t corner[4] = {cell, cell + axes[0], cell + axes[0] + axes[1],
                                  cell + axes[0] + axes[1] + axes[2]};
      std::vector<uint32_t> in;
      std::vector<uint32_t> out;
      for (const uint32_t c : corner) {
        (field[c] > 0 ? in : out).push_back(c);
      }
      if (in.empty() || out.empty()) {
        continue;
      }
      Vec3 outwards{0, 0, 0};
      for (const uint32_t c : out) {
        outwards = outwards + pointAt(c) * (1.0 / static_cast<double>(out.size()));
      }
      for (const uint32_t c : in) {
        outwards = outwards - pointAt(c) * (1.0 / static_cast<double>(in.size()));
      }
      if (in.size() == 2) {
        const uint32_t a = cut(in[0], out[0]);
        const uint32_t b = cut(in[0], out[1]);
        const uint32_t c = cut(in[1], out[1]);
        const uint32_t d = cut(in[1], out[0]);
        add(a, b, c, outwards);
        add(a, c, d, outwards);
      } else {
        const std::vector<uint32_t>& one = in.size() == 1 ? in : out;
        const std::vector<uint32_t>& three = in.size() == 1 ? out : in;
        add(cut(one[0], three[0]), cut(one[0], three[1]), cut(one[0], three[2]), outwards);
      }
    }
  }
  for (const Vec3& p : positions) {
    addPosition(mesh, p);
  }
  return mesh;
}

}  // namespace

BodyMesh bodyMesh(const std::string& body) {
  if (body == "stratocumulus") {
    return stratocumulus();
  }
  if (body == "cumulus") {
    return cumulus<64>(28);
  }
  if (body == "cumulus-coarse") {
    return cumulus<20>(95);
  }
  throw std::invalid_argument("no body " + body);
}

}  // namespace bench
