// SPDX-License-Identifier: MIT
// A cumulus as the zero of a field, cut out of a lattice by marching tetrahedra: A. Gueziec and
// R. Hummel, "Exploiting triangulated surface extraction using tetrahedral decomposition", 1995.
#include <algorithm>
#include <unordered_map>

#include "common/cloud_mesh.hpp"
#include "common/noise.hpp"
#include "common/parallel.hpp"

namespace host {
namespace {

struct Lobe {
  Vec3 centre;
  double radius = 0.0;
};

// In units of the extent, the base at 0. Lobes get smaller outwards and upwards.
std::vector<Lobe> placeLobes(const CumulusMesh& shape) {
  const auto random = [&](uint32_t lobe, int32_t what) {
    return unitFromHash(hashLattice(static_cast<int32_t>(lobe), what, 77, shape.seed));
  };
  std::vector<Lobe> lobes = {{{0.0, 0.36, 0.0}, 0.28}};
  for (uint32_t i = 1; i < shape.lobes; ++i) {
    const double angle = 2.0 * PI * random(i, 0);
    const double out = 0.32 * std::sqrt(random(i, 1));
    // Low at the sides, up to a tower in the middle.
    const double up = 0.1 + (0.52 - 1.1 * out) * std::max(random(i, 2), 0.05);
    const double radius = (0.1 + 0.1 * random(i, 3)) * (1.15 - 0.6 * up);
    lobes.push_back({{out * std::cos(angle), up, out * std::sin(angle)}, radius});
  }
  return lobes;
}

// Of two distances to surfaces, the lesser, rounded where they are within `blend`.
double smoothMin(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - 0.25 * h * h * blend;
}

// Negative inside; about a distance, in units of the extent's mean.
class Field {
 public:
  explicit Field(const CumulusMesh& shape) : shape_(shape), lobes_(placeLobes(shape)) {}

  [[nodiscard]] double at(Vec3 p) const {
    double distance = 10.0;
    for (const Lobe& lobe : lobes_) {
      distance = smoothMin(distance, length(p - lobe.centre) - lobe.radius, 0.05);
    }
    // Flat base: what lies below is cut, its edge rounded.
    distance = -smoothMin(-distance, p.y, 0.06);
    const double depth = 0.28 * shape_.billows;
    if (depth > 0.0 && std::abs(distance) < 2.5 * depth) {
      // Round knobs with creases between, of three sizes; quiet towards the base.
      double knobs = 0.0;
      double amplitude = 1.0;
      double scale = 6.0;
      for (uint32_t i = 0; i < 3; ++i) {
        const double d = worley(p * scale + Vec3{0.3, 0.7, 0.1}, shape_.seed + 11 * i);
        knobs += amplitude * (0.75 - std::min(d, 1.2) * std::min(d, 1.2));
        amplitude *= 0.45;
        scale *= 2.1;
      }
      distance -= depth * knobs * std::clamp(p.y / 0.15, 0.1, 1.0);
    }
    return distance;
  }

 private:
  const CumulusMesh& shape_;
  std::vector<Lobe> lobes_;
};

class Lattice {
 public:
  explicit Lattice(const CumulusMesh& shape) : extent_(shape.extent) {
    // Half a cell of air around keeps the surface closed; billows stand out by less than 0.15.
    constexpr double LOW = -0.08;
    constexpr double HIGH = 1.08;
    const double edge = std::max({shape.extent.x, shape.extent.y, shape.extent.z}) / shape.detail;
    const auto cells = [&](double length) {
      return std::max(8u, static_cast<uint32_t>(std::ceil((HIGH - LOW) * length / edge)));
    };
    points_ = {cells(extent_.x) + 1, cells(extent_.y) + 1, cells(extent_.z) + 1};
    low_ = {LOW - 0.5, LOW, LOW - 0.5};
    step_ = {(HIGH - LOW) / (points_[0] - 1), (HIGH - LOW) / (points_[1] - 1),
             (HIGH - LOW) / (points_[2] - 1)};
    value_.resize(size_t{points_[0]} * points_[1] * points_[2]);
    const Field field(shape);
    parallelFor(points_[2], [&](uint32_t z) {
      for (uint32_t y = 0; y < points_[1]; ++y) {
        for (uint32_t x = 0; x < points_[0]; ++x) {
          const bool border = x == 0 || y == 0 || z == 0 || x + 1 == points_[0] ||
                              y + 1 == points_[1] || z + 1 == points_[2];
          const double value = field.at(unit(x, y, z));
          value_[index(x, y, z)] = border ? std::max(value, 1e-3) : value;
        }
      }
    });
  }

  [[nodiscard]] uint32_t index(uint32_t x, uint32_t y, uint32_t z) const {
    return x + points_[0] * (y + points_[1] * z);
  }
  [[nodiscard]] const std::array<uint32_t, 3>& points() const { return points_; }
  [[nodiscard]] double value(uint32_t point) const { return value_[point]; }
  [[nodiscard]] Vec3 place(uint32_t point) const {
    return unit(point % points_[0], point / points_[0] % points_[1],
                point / points_[0] / points_[1]) *
           extent_;
  }

 private:
  [[nodiscard]] Vec3 unit(uint32_t x, uint32_t y, uint32_t z) const {
    return low_ + step_ * Vec3{1.0 * x, 1.0 * y, 1.0 * z};
  }

  Vec3 extent_;
  std::array<uint32_t, 3> points_{};
  Vec3 low_;
  Vec3 step_;
  std::vector<double> value_;
};

class Polygoniser {
 public:
  Polygoniser(const Lattice& lattice, CloudMesh& mesh) : lattice_(lattice), mesh_(mesh) {}

  // Corners in right-handed order: (b - a) x (c - a) . (d - a) > 0.
  void tetrahedron(const std::array<uint32_t, 4>& corner) {
    std::array<uint32_t, 4> in{};
    std::array<uint32_t, 4> out{};
    uint32_t inside = 0;
    uint32_t outside = 0;
    bool odd = false;  // permutation from `corner` to insiders, then outsiders
    for (const uint32_t point : corner) {
      if (lattice_.value(point) < 0.0) {
        in[inside++] = point;
        odd = odd != (outside % 2 == 1);
      } else {
        out[outside++] = point;
      }
    }
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
      mesh_.triangles.push_back(odd ? std::array{a, c, b} : std::array{a, b, c});
    };
    if (inside == 1) {
      add(cut(in[0], out[0]), cut(in[0], out[1]), cut(in[0], out[2]));
    } else if (inside == 3) {
      add(cut(in[0], out[0]), cut(in[1], out[0]), cut(in[2], out[0]));
    } else if (inside == 2) {
      const uint32_t a = cut(in[0], out[0]);
      const uint32_t b = cut(in[0], out[1]);
      const uint32_t c = cut(in[1], out[1]);
      const uint32_t d = cut(in[1], out[0]);
      add(a, b, c);
      add(a, c, d);
    }
  }

 private:
  // The vertex on an edge of the lattice; all tetrahedra around it share it.
  uint32_t cut(uint32_t inside, uint32_t outside) {
    const uint64_t key = (uint64_t{std::min(inside, outside)} << 32) | std::max(inside, outside);
    const auto [found, fresh] =
        vertex_.try_emplace(key, static_cast<uint32_t>(mesh_.positions.size()));
    if (fresh) {
      const double a = lattice_.value(inside);
      const double b = lattice_.value(outside);
      // Off the lattice's points, where triangles would have no area.
      const double t = std::clamp(a / (a - b), 0.05, 0.95);
      const Vec3 p = lattice_.place(inside) * (1.0 - t) + lattice_.place(outside) * t;
      mesh_.positions.push_back(
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    return found->second;
  }

  const Lattice& lattice_;
  CloudMesh& mesh_;
  std::unordered_map<uint64_t, uint32_t> vertex_;
};

// Fits the mesh to the extent, the base at 0.
void fit(CloudMesh& mesh, Vec3 extent) {
  const Affine box = boundsOf(mesh);
  const Vec3 low = extent * Vec3{-0.5, 0.0, -0.5};
  for (auto& position : mesh.positions) {
    const std::array<double, 3> start{low.x, low.y, low.z};
    const std::array<double, 3> size{extent.x, extent.y, extent.z};
    for (size_t i = 0; i < 3; ++i) {
      const double share = (double{position[i]} - box[4 * i + 3]) / box[5 * i];
      position[i] = static_cast<float>(start[i] + share * size[i]);
    }
  }
}

}  // namespace

CloudMesh makeMesh(const CumulusMesh& shape) {
  // Paths from corner 0 to corner 7 of a cube, one axis after the other: six tetrahedra that meet
  // those of the next cubes face to face. Bits of a corner are its x, y, z.
  constexpr std::array<std::array<uint32_t, 4>, 6> TETRAHEDRA = {
      {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}}};
  const Lattice lattice(shape);
  CloudMesh mesh;
  Polygoniser polygoniser(lattice, mesh);
  const auto& points = lattice.points();
  for (uint32_t z = 0; z + 1 < points[2]; ++z) {
    for (uint32_t y = 0; y + 1 < points[1]; ++y) {
      for (uint32_t x = 0; x + 1 < points[0]; ++x) {
        std::array<uint32_t, 8> corner{};
        uint32_t inside = 0;
        for (uint32_t i = 0; i < 8; ++i) {
          corner[i] = lattice.index(x + (i & 1u), y + ((i >> 1) & 1u), z + (i >> 2));
          inside += lattice.value(corner[i]) < 0.0 ? 1u : 0u;
        }
        if (inside == 0 || inside == 8) {
          continue;
        }
        for (const auto& [a, b, c, d] : TETRAHEDRA) {
          polygoniser.tetrahedron({corner[a], corner[b], corner[c], corner[d]});
        }
      }
    }
  }
  fit(mesh, shape.extent);
  return mesh;
}

}  // namespace host
