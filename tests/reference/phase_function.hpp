// SPDX-License-Identifier: MIT
// Phase functions in 1/sr, normalised over the sphere, with samples drawn by exact inversion of
// exactly that function. The argument is y = 1 - cos of the scattering angle, so that forward peaks
// of 1e5 keep their precision.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "reference/vector.hpp"

namespace welkin::reference {

class PhaseFunction {
 public:
  static PhaseFunction isotropic() { return henyeyGreenstein(0); }
  // 3 / (16 pi) (1 + cos^2).
  static PhaseFunction rayleigh();
  // Mean cosine g in (-1, 1).
  static PhaseFunction henyeyGreenstein(double g);
  // Angles (rad) rising from 0 to pi and a value for each in any unit, >= 0. Linear in y between
  // them; divided by its own integral, which is a closed form, channel by channel.
  static PhaseFunction table(const std::vector<double>& angles, const std::vector<Rgb>& values);

  // 1/sr at y in [0, 2].
  double value(size_t channel, double y) const;
  // y up to which the part u of the energy is scattered.
  double sample(size_t channel, double u) const;
  // Whether the channels are the same function.
  bool grey() const;

 private:
  enum class Kind { RAYLEIGH, HENYEY_GREENSTEIN, TABLE };
  struct Table;

  Kind kind_ = Kind::HENYEY_GREENSTEIN;
  double g_ = 0;
  std::shared_ptr<const Table> table_;
};

}  // namespace welkin::reference
