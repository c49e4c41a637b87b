// SPDX-License-Identifier: MIT
// The dispatches that compute the light inside a volume, in order, and their shares of the cost: a
// volume's light may be computed part by part. Each result depends on the order alone, not on where
// parts end.
#pragma once

#include "frame/transport.hpp"
#include "vk/pipelines.hpp"

namespace welkin {

struct TransportStep {
  vk::Pass pass = vk::Pass::TransportSweep;
  uint32_t level = 0;
  uint32_t flags = 0;
  uint32_t groups = 0;
  uint32_t rows = 1;  // of so many groups each

  // A step may end after any of its rows; where it has one, after any group.
  uint32_t units() const { return rows > 1 ? rows : groups; }
};

// Rounds over the level that is solved, the one below it in each of those, and over the coarsest.
struct TransportRounds {
  uint32_t begun, solved, middle, coarsest;
};

class TransportSteps {
 public:
  explicit TransportSteps(const TransportShape& shape);

  // Calls visit(step, first unit, units) with what part [from, to) of `parts` has of each step,
  // where that is not nothing. Parts cost about the same.
  template <typename Visit>
  void visit(uint32_t from, uint32_t to, uint32_t parts, const Visit& visit) const {
    uint64_t all = 0;
    each([&](const TransportStep& step) { all += cost(step); });
    const uint64_t begin = all * from / parts;
    const uint64_t end = all * to / parts;
    uint64_t at = 0;
    each([&](const TransportStep& step) {
      const uint64_t own = cost(step);
      const uint32_t first = unitsBefore(step, at, own, begin);
      const uint32_t last = unitsBefore(step, at, own, end);
      if (last > first) {
        visit(step, first, last - first);
      }
      at += own;
    });
  }

  // Time on two cores by lavapipe, roughly, 0.1 us.
  uint64_t cost(const TransportStep& step) const;

 private:
  template <typename Visit>
  void each(const Visit& visit) const {
    if (shape_.layer) {
      visit(step(vk::Pass::TransportResponse, 0, 0,
                 interface_::RESPONSE_ZENITHS * interface_::RESPONSE_AZIMUTHS +
                     transportDirections(0, shape_) + interface_::TRANSPORT_TERMS));
    }
    visit(step(vk::Pass::TransportDepth, 0, 0, 4 * rays(0)));
    for (uint32_t level = 0; level < interface_::TRANSPORT_LEVELS; ++level) {
      visit(step(vk::Pass::TransportCells, level, 0, sizes_.cells[level]));
    }
    solve(1, 0, visit);
    visit(step(vk::Pass::TransportExtrapolate, 1, 0, sizes_.cells[1]));
    solve(0, interface_::TRANSPORT_COARSER, visit);
    visit(step(vk::Pass::TransportExtrapolate, 0, 0, sizes_.cells[0]));
  }

  // Light of a level by itself, from what the coarser one has found or from none.
  template <typename Visit>
  void solve(uint32_t level, uint32_t from, const Visit& visit) const {
    sweep(level, interface_::TRANSPORT_FIRST_SWEEP, visit);
    visit(step(vk::Pass::TransportSource, level, interface_::TRANSPORT_SECOND_SWEEP,
               sizes_.cells[level]));
    sweep(level, interface_::TRANSPORT_SECOND_SWEEP, visit);
    visit(step(vk::Pass::TransportSource, level, from, sizes_.cells[level]));
    const uint32_t rounds = level == 0 ? rounds_.solved : rounds_.begun;
    for (uint32_t round = 0; round < rounds; ++round) {
      cycle(level, visit);
    }
  }

  template <typename Visit>
  void sweep(uint32_t level, uint32_t flags, const Visit& visit) const {
    TransportStep rays_ = step(vk::Pass::TransportSweep, level, flags, rays(level));
    rays_.rows = transportDirections(level, shape_);
    visit(rays_);
    visit(step(vk::Pass::TransportGather, level, flags, sizes_.cells[level]));
  }

  // One round of scattering, then what the coarser levels know about all that follow.
  template <typename Visit>
  void cycle(uint32_t level, const Visit& visit) const {
    sweep(level, 0, visit);
    const uint32_t below = level + 1;
    uint32_t flags = 0;
    if (below < interface_::TRANSPORT_LEVELS) {
      TransportStep restrict_ = step(vk::Pass::TransportRestrict, below, 0, sizes_.cells[below]);
      restrict_.rows = interface_::TRANSPORT_TERMS;
      visit(restrict_);
      visit(step(vk::Pass::TransportSource, below, 0, sizes_.cells[below]));
      const bool last = below + 1 == interface_::TRANSPORT_LEVELS;
      for (uint32_t round = 0; round < (last ? rounds_.coarsest : rounds_.middle); ++round) {
        cycle(below, visit);
      }
      flags = interface_::TRANSPORT_COARSER;
    }
    visit(step(vk::Pass::TransportSource, level, flags, sizes_.cells[level]));
  }

  static TransportStep step(vk::Pass pass, uint32_t level, uint32_t flags, uint32_t threads) {
    return {pass, level, flags,
            (threads + interface_::TRANSPORT_GROUP - 1) / interface_::TRANSPORT_GROUP, 1};
  }
  // Rays of a direction, at most.
  uint32_t rays(uint32_t level) const;
  // Units of a step that begin before a place in the sequence.
  static uint32_t unitsBefore(const TransportStep& step, uint64_t at, uint64_t cost,
                              uint64_t place);

  TransportShape shape_;
  TransportSizes sizes_;
  TransportRounds rounds_;
};

}  // namespace welkin
