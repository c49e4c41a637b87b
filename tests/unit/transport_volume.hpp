// SPDX-License-Identifier: MIT
// A volume without voxels whose optical depth is given, for the tests of src/frame/transport*.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <memory_resource>

#include "frame/transport.hpp"

namespace transport_test {

using namespace welkin;

class TransportVolume : public ::testing::Test {
 protected:
  TransportVolume() {
    volume_.size = {16, 16, 16};
    peak_ = addField(0.85, 1);
    place(40, 1);
  }

  // The medium's peak.
  double addField(double asymmetry, double albedo) {
    ParticleParams params;
    params.asymmetry = asymmetry;
    params.analytic = true;
    FieldState& field = volume_.fields[volume_.fieldCount++];
    field.medium = makeMedium(ParticleType::HenyeyGreenstein, params, {albedo, albedo, albedo});
    field.tables = std::make_shared<MediumTables>();
    return field.tables->own.transport(*field.medium.particle).peak;
  }

  // A box `width` long, wide, and `height` high, y up.
  void place(double width, double height) {
    volume_.worldFromBox[0] = {width, 0, 0};
    volume_.worldFromBox[1] = {0, height, 0};
    volume_.worldFromBox[2] = {0, 0, width};
    height_ = height;
  }

  // Optical depth of filled columns, the peak included; rows of voxels [0, rows) are filled, a part
  // `cover` of them.
  void fill(double depth, uint32_t rows = 16, double cover = 1, size_t index = 0) {
    FieldState& field = volume_.fields[index];
    const double value = depth / height_ * 16 / rows;
    field.extinctionScale = 1;
    field.mean = cover * rows / 16 * value;
    field.meanSquare = field.mean * value;
    field.filled.first = {0, 0, 0};
    field.filled.end = {16, rows, 16};
  }

  VolumeState volume_{std::pmr::get_default_resource()};
  double peak_ = 0;
  double height_ = 1;
};

}  // namespace transport_test
