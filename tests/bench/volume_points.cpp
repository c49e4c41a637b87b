// SPDX-License-Identifier: MIT
#include "bench/volume_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace bench {
namespace {

// Points that no other of the method beats, slowest first.
std::vector<const VolumeRow*> frontOf(const std::vector<VolumeRow>& rows, const std::string& method,
                                      double VolumeRow::*time) {
  std::vector<const VolumeRow*> front;
  for (const VolumeRow& row : rows) {
    if (row.method == method) {
      front.push_back(&row);
    }
  }
  std::erase_if(front, [&, all = front](const VolumeRow* row) {
    return std::any_of(all.begin(), all.end(), [&](const VolumeRow* other) {
      return other != row && other->error <= row->error && other->*time <= row->*time;
    });
  });
  std::sort(front.begin(), front.end(),
            [](const VolumeRow* a, const VolumeRow* b) { return a->error < b->error; });
  return front;
}

}  // namespace

double timeAtError(const std::vector<VolumeRow>& rows, const std::string& method, double error,
                   double VolumeRow::*time) {
  const std::vector<const VolumeRow*> front = frontOf(rows, method, time);
  constexpr double ROUNDING = 1e-9;
  if (!front.empty() && error > front.back()->error) {
    return front.back()->*time;  // the cheapest, with an error to spare
  }
  for (size_t i = 0; i + 1 < front.size(); ++i) {
    const VolumeRow& a = *front[i];
    const VolumeRow& b = *front[i + 1];
    if (error >= a.error * (1 - ROUNDING) && error <= b.error * (1 + ROUNDING)) {
      const double at = std::log(error / a.error) / std::log(b.error / a.error);
      return std::exp((1 - at) * std::log(a.*time) + at * std::log(b.*time));
    }
  }
  return -1;
}

std::vector<double> commonErrors(const std::vector<VolumeRow>& rows) {
  double low = 0;
  double high = 1e30;
  for (const char* method : {"welkin", "slicer"}) {
    const auto front = frontOf(rows, method, &VolumeRow::time_ms);
    if (front.size() < 2) {
      return {};
    }
    low = std::max(low, front.front()->error);
    high = std::min(high, front.back()->error);
  }
  if (!(low < high)) {
    return {};
  }
  std::vector<double> errors{high, std::sqrt(low * high), low};
  if (low < DIVIDING_ERROR && DIVIDING_ERROR < high) {
    errors.push_back(DIVIDING_ERROR);
    std::sort(errors.rbegin(), errors.rend());
  }
  return errors;
}

Fit fitLine(const std::vector<double>& x, const std::vector<double>& y) {
  const auto line = [](const std::vector<double>& a, const std::vector<double>& b) {
    const auto n = static_cast<double>(a.size());
    const double meanA = std::accumulate(a.begin(), a.end(), 0.0) / n;
    const double meanB = std::accumulate(b.begin(), b.end(), 0.0) / n;
    double ab = 0;
    double aa = 0;
    double bb = 0;
    for (size_t i = 0; i < a.size(); ++i) {
      ab += (a[i] - meanA) * (b[i] - meanB);
      aa += (a[i] - meanA) * (a[i] - meanA);
      bb += (b[i] - meanB) * (b[i] - meanB);
    }
    const double slope = ab / aa;
    return std::array<double, 3>{meanB - slope * meanA, slope, bb > 0 ? ab * ab / (aa * bb) : 1.0};
  };
  const auto logarithms = [](std::vector<double> values) {
    for (double& value : values) {
      value = std::log(value);
    }
    return values;
  };
  const auto [offset, slope, explained] = line(x, y);
  return {offset, slope, explained, line(logarithms(x), logarithms(y))[1]};
}

}  // namespace bench
