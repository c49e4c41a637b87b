// SPDX-License-Identifier: MIT
#include "frame/transport_rays.hpp"

#include <cmath>

namespace welkin {

using interface_::TransportDirection;
constexpr int TERMS = interface_::TRANSPORT_TERMS;

TransportQuadrature transportQuadrature() {
  TransportQuadrature q{};
  size_t next = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int parts = x * x + y * y + z * z;
        if (parts > 0) {
          q.direction[next] = glm::normalize(glm::dvec3(x, y, z));
          q.coarse[next] = parts == 1 ? 1.0 / 21 : parts == 2 ? 4.0 / 105 : 9.0 / 280;
          q.fine[next++] = parts == 1 ? 4.0 / 315 : parts == 2 ? 64.0 / 2835 : 27.0 / 1280;
        }
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int signs = 0; signs < 8; ++signs) {
      glm::dvec3 v((signs & 1) != 0 ? -1 : 1, (signs & 2) != 0 ? -1 : 1, (signs & 4) != 0 ? -1 : 1);
      v[axis] *= 3;
      q.direction[next] = glm::normalize(v);
      q.fine[next++] = 14641.0 / 725760;
    }
  }
  return q;
}

std::array<double, TERMS> transportHarmonics(const glm::dvec3& v) {
  const double x = v.x;
  const double y = v.y;
  const double z = v.z;
  const double squares = x * x - y * y;
  return {1.0,
          std::sqrt(3.0) * y,
          std::sqrt(3.0) * z,
          std::sqrt(3.0) * x,
          std::sqrt(15.0) * x * y,
          std::sqrt(15.0) * y * z,
          std::sqrt(5.0) / 2 * (3 * z * z - 1),
          std::sqrt(15.0) * x * z,
          std::sqrt(15.0) / 2 * squares,
          std::sqrt(35.0 / 8) * y * (3 * x * x - y * y),
          std::sqrt(105.0) * x * y * z,
          std::sqrt(21.0 / 8) * y * (5 * z * z - 1),
          std::sqrt(7.0) / 2 * z * (5 * z * z - 3),
          std::sqrt(21.0 / 8) * x * (5 * z * z - 1),
          std::sqrt(105.0) / 2 * z * squares,
          std::sqrt(35.0 / 8) * x * (x * x - 3 * y * y)};
}

TransportDirection transportDirection(const glm::dmat3& cellsFromWorld, const glm::dvec3& direction,
                                      double weight) {
  const glm::dvec3 speed = cellsFromWorld * direction;  // cells per m
  int main = 0;
  for (int axis = 1; axis < 3; ++axis) {
    // The margin keeps the choice from hanging on rounding.
    if (std::abs(speed[axis]) > std::abs(speed[main]) * (1 + 1e-9)) {
      main = axis;
    }
  }
  const int u = (main + 1) % 3;
  const int v = (main + 2) % 3;
  const double path = 1 / std::abs(speed[main]);
  TransportDirection out;
  out.step_ = glm::vec4(glm::dvec4(speed[u] * path, speed[v] * path, path, weight));
  out.axes = {main, u, v, speed[main] > 0 ? 1 : -1};
  return out;
}

glm::dmat3 transportCellsFromWorld(const glm::dmat3& boxFromWorld, const TransportShape& shape,
                                   double perCell) {
  glm::dmat3 scale(1.0);
  for (int i = 0; i < 3; ++i) {
    scale[i][i] = perCell * shape.cells[static_cast<size_t>(i)] / shape.size[i];
  }
  return scale * boxFromWorld;
}

glm::dmat3 transportTurn(const glm::dmat3& box) {
  const glm::dvec3 a = glm::normalize(box[0]);
  const glm::dvec3 b = glm::normalize(box[1] - a * glm::dot(a, box[1]));
  return {a, b, glm::cross(a, b)};
}

namespace {

glm::dvec3 tilted(const glm::dvec3& v, int axis) {
  constexpr double TURN = 0.4;
  constexpr double TILT = 0.25;
  const int u = (axis + 1) % 3;
  const int w = (axis + 2) % 3;
  glm::dvec3 r = v;
  r[u] = v[u] * std::cos(TURN) - v[w] * std::sin(TURN);
  r[w] = v[u] * std::sin(TURN) + v[w] * std::cos(TURN);
  const double side = r[w] * std::cos(TILT) - r[axis] * std::sin(TILT);
  r[axis] = r[w] * std::sin(TILT) + r[axis] * std::cos(TILT);
  r[w] = side;
  return r;
}

}  // namespace

std::array<glm::dvec3, TransportQuadrature::COUNT> transportDirectionsIn(
    const glm::dmat3& box, const TransportShape& shape) {
  const glm::dmat3 turn = transportTurn(box);
  const TransportQuadrature q = transportQuadrature();
  std::array<glm::dvec3, TransportQuadrature::COUNT> directions;
  for (size_t d = 0; d < directions.size(); ++d) {
    directions[d] =
        turn * (shape.thinAxis >= 0 ? tilted(q.direction[d], shape.thinAxis) : q.direction[d]);
  }
  return directions;
}

void removeLowDegrees(std::array<glm::dvec3, FINE_NODES>& kernel) {
  const auto legendre = [](double x) {
    return glm::dvec4(1, x, 0.5 * (3 * x * x - 1), 0.5 * x * (5 * x * x - 3));
  };
  // x = 1 - 2 h^2, dx = 4 h dh; trapezia in h, which leave the functions nearly orthogonal.
  const auto node = [](size_t n) { return static_cast<double>(n) / (FINE_NODES - 1); };
  std::array<glm::dvec3, 4> moments{};
  for (size_t n = 0; n < FINE_NODES; ++n) {
    const double h = node(n);
    const double weight = (n + 1 == FINE_NODES ? 0.5 : 1.0) * 4 * h / (FINE_NODES - 1);
    const glm::dvec4 p = legendre(1 - 2 * h * h);
    for (int l = 0; l < 4; ++l) {
      moments[static_cast<size_t>(l)] += weight * (l + 0.5) * p[l] * kernel[n];
    }
  }
  for (size_t n = 0; n < FINE_NODES; ++n) {
    const double h = node(n);
    const glm::dvec4 p = legendre(1 - 2 * h * h);
    for (int l = 0; l < 4; ++l) {
      kernel[n] -= p[l] * moments[static_cast<size_t>(l)];
    }
  }
}

}  // namespace welkin
