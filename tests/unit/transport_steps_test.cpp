// SPDX-License-Identifier: MIT
// src/frame/transport_steps: parts of the sequence together are the sequence, in its order, and
// cost about the same.
#include "frame/transport_steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace {

using namespace welkin;

struct Piece {
  TransportStep step;
  uint32_t first, units;
};

std::vector<Piece> piecesOf(const TransportSteps& steps, uint32_t from, uint32_t to,
                            uint32_t parts) {
  std::vector<Piece> pieces;
  steps.visit(from, to, parts, [&](const TransportStep& step, uint32_t first, uint32_t units) {
    pieces.push_back({step, first, units});
  });
  return pieces;
}

bool same(const TransportStep& a, const TransportStep& b) {
  return a.pass == b.pass && a.level == b.level && a.flags == b.flags && a.groups == b.groups &&
         a.rows == b.rows;
}

std::vector<TransportShape> shapes() {
  TransportShape cube;
  cube.cells = {32, 32, 32};
  TransportShape small;
  small.cells = {8, 8, 8};
  TransportShape odd;
  odd.cells = {48, 24, 24};
  TransportShape layer;
  layer.cells = {16, 16, 16};
  layer.thinAxis = 1;
  layer.layer = true;
  return {cube, small, odd, layer};
}

TEST(TransportSteps, OfAllPartsAreTheWholeInOrder) {
  for (const TransportShape& shape : shapes()) {
    const TransportSteps steps(shape);
    const std::vector<Piece> whole = piecesOf(steps, 0, 1, 1);
    EXPECT_GT(whole.size(), 500u);
    for (const uint32_t parts : {2u, 3u, 16u, 63u, 64u}) {
      size_t at = 0;
      uint32_t done = 0;  // units of step `at`
      for (uint32_t part = 0; part < parts; ++part) {
        for (const Piece& piece : piecesOf(steps, part, part + 1, parts)) {
          ASSERT_LT(at, whole.size());
          ASSERT_TRUE(same(piece.step, whole[at].step)) << part << " of " << parts;
          ASSERT_EQ(piece.first, done);
          ASSERT_GT(piece.units, 0u);
          done += piece.units;
          ASSERT_LE(done, piece.step.units());
          if (done == piece.step.units()) {
            ++at;
            done = 0;
          }
        }
      }
      EXPECT_EQ(at, whole.size()) << parts;
    }
  }
}

// By the cost that the sequence is shared out by; the figures of tests/bench judge that cost.
TEST(TransportSteps, PartsCostTheSame) {
  for (const TransportShape& shape : shapes()) {
    const TransportSteps steps(shape);
    for (const uint32_t parts : {8u, 64u}) {
      double most = 0;
      double unit = 0;  // the largest, which is not shared
      double sum = 0;
      for (uint32_t part = 0; part < parts; ++part) {
        double cost = 0;
        for (const Piece& piece : piecesOf(steps, part, part + 1, parts)) {
          const double one = static_cast<double>(steps.cost(piece.step)) / piece.step.units();
          unit = std::max(unit, one);
          cost += one * piece.units;
        }
        most = std::max(most, cost);
        sum += cost;
      }
      EXPECT_LE(most, sum / parts + 1.01 * unit) << shape.cells[0] << ", " << parts;
    }
  }
}

}  // namespace
