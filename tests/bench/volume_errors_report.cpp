// SPDX-License-Identifier: MIT
#include "bench/volume_errors_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "bench/front_timing.hpp"

namespace bench {
namespace {

constexpr double COVERED = 2e-3;  // of the brightest pixel
constexpr const char* BEGIN = "<!-- volume-errors:begin -->";
constexpr const char* END = "<!-- volume-errors:end -->";

// Of the pixels brighter than `least`, over their mean.
double relativeRms(const std::vector<double>& picture, const TruthImage& truth, double least) {
  double square = 0;
  double sum = 0;
  double count = 0;
  for (size_t i = 0; i < picture.size(); ++i) {
    if (truth.radiance[i] >= least) {
      const double difference = picture[i] - truth.radiance[i];
      square += difference * difference - truth.error[i] * truth.error[i];
      sum += truth.radiance[i];
      count += 1;
    }
  }
  return std::sqrt(std::max(square, 0.0) * count) / sum;
}

struct Column {
  const char* form;
  const char* level;
};
constexpr Column COLUMNS[] = {{"all-orders", "low"},       {"all-orders", "medium"},
                              {"all-orders", "high"},      {"all-orders", "ultra"},
                              {"forward", "low"},          {"forward", "medium"},
                              {"forward", "high"},         {"forward", "ultra"},
                              {"forward-integer", "low"},  {"forward-integer", "medium"},
                              {"forward-integer", "high"}, {"forward-integer", "ultra"},
                              {"single", "low"},           {"single", "medium"},
                              {"single", "high"},          {"single", "ultra"}};

std::vector<const Ordered*> rowsOf(const Ordered& rows, const std::string& kind, const Column& c) {
  std::vector<const Ordered*> found;
  for (const Ordered& row : rows) {
    if (row.at("kind") == kind && row.at("form") == c.form && row.at("level") == c.level) {
      found.push_back(&row);
    }
  }
  return found;
}

std::string format(const char* pattern, double a, double b = 0, double c = 0) {
  char text[96];
  std::snprintf(text, sizeof text, pattern, a, b, c);
  return text;
}

// A line per picture, a column per form and level that was run for most of them: quick runs add
// some forms for one picture of each kind.
std::string pictureTable(const Ordered& rows, const std::string& kind) {
  std::vector<Column> columns;
  size_t most = 0;
  for (const Column& column : COLUMNS) {
    most = std::max(most, rowsOf(rows, kind, column).size());
  }
  std::vector<std::string> names;
  std::string head = "| " + kind + " |";
  std::string line = "|---|";
  for (const Column& column : COLUMNS) {
    const std::vector<const Ordered*> found = rowsOf(rows, kind, column);
    if (2 * found.size() <= most) {
      continue;
    }
    for (const Ordered* row : found) {
      const std::string name = row->at("case");
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
      }
    }
    columns.push_back(column);
    head += std::string(" ") + column.form + ", " + column.level + " |";
    line += "---|";
  }
  std::string text = head + "\n" + line + "\n";
  for (const std::string& name : names) {
    text += "| " + name.substr(kind.size() + 1) + " |";
    for (const Column& column : columns) {
      std::string cell = "-";
      for (const Ordered* row : rowsOf(rows, kind, column)) {
        if (row->at("case") == name) {
          cell = format("%.3f / %.1f / %.1f", row->at("total"), 100 * row->at("rms").get<double>(),
                        100 * row->at("rmsCovered").get<double>());
        }
      }
      text += " " + cell + " |";
    }
    text += "\n";
  }
  return text;
}

std::string slabTable(const Ordered& rows) {
  std::string text =
      "| slabs | views | median, % | 90th percentile, % | worst, % | worst case |\n"
      "|---|---|---|---|---|---|\n";
  for (const Column& column : COLUMNS) {
    for (const std::string phase : {"hg", "droplets"}) {
      const std::string start = "slab-" + phase + "-";
      std::vector<std::pair<double, std::string>> errors;
      for (const Ordered* row : rowsOf(rows, "slab", column)) {
        const std::string name = row->at("case");
        if (name.rfind(start, 0) == 0) {
          errors.emplace_back(100 * std::fabs(row->at("total").get<double>() - 1),
                              name.substr(start.size()));
        }
      }
      if (errors.empty()) {
        continue;
      }
      std::sort(errors.begin(), errors.end());
      const size_t last = errors.size() - 1;
      const auto at = [&](size_t percent) { return errors[(last * percent + 50) / 100].first; };
      text += std::string("| ") + column.form + ", " + column.level + ", " + phase + " | " +
              std::to_string(errors.size()) +
              format(" | %.1f | %.1f | %.1f | ", at(50), at(90), errors[last].first) +
              errors[last].second + " |\n";
    }
  }
  return text;
}

std::string medianText(const std::vector<const Ordered*>& rows, const char* key) {
  std::vector<double> values;
  for (const Ordered* row : rows) {
    if (!row->at(key).is_null()) {
      values.push_back(row->at(key).get<double>());
    }
  }
  if (values.empty()) {
    return "-";
  }
  const double median = medianOf(values);
  return format(median < 9.95 ? "%.1f" : "%.0f", median);
}

std::string timeTable(const Ordered& rows) {
  std::string text =
      "| CPU ms | sphere: light | frame | cumulus: light | frame | slab: light | frame |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Column& column : COLUMNS) {
    std::string line;
    size_t count = 0;
    for (const char* kind : {"sphere", "cumulus", "slab"}) {
      const std::vector<const Ordered*> found = rowsOf(rows, kind, column);
      count += found.size();
      line += " " + medianText(found, "light_ms") + " | " + medianText(found, "frame_ms") + " |";
    }
    if (count != 0) {
      text += std::string("| ") + column.form + ", " + column.level + " |" + line + "\n";
    }
  }
  return text;
}

}  // namespace

VolumeErrors volumeErrors(const std::vector<double>& picture, const TruthImage& truth) {
  VolumeErrors errors;
  double sum = 0;
  for (const double value : picture) {
    sum += value;
  }
  errors.total = sum / static_cast<double>(picture.size()) / truth.mean();
  errors.rms = relativeRms(picture, truth, 0);
  errors.rmsCovered = relativeRms(
      picture, truth, COVERED * *std::max_element(truth.radiance.begin(), truth.radiance.end()));
  return errors;
}

Ordered readRows(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) {
    return Ordered::array();
  }
  return Ordered::parse(stream).at("rows");
}

void putRow(Ordered& rows, const Ordered& row) {
  for (Ordered& other : rows) {
    if (other.at("case") == row.at("case") && other.at("level") == row.at("level") &&
        other.at("form") == row.at("form")) {
      other = row;
      return;
    }
  }
  rows.push_back(row);
}

void writeTables(const std::string& page, const Ordered& rows) {
  std::stringstream content;
  content << std::ifstream(page).rdbuf();
  std::string text = content.str();
  const size_t begin = text.find(BEGIN);
  const size_t end = text.find(END);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    throw std::runtime_error(page + ": expected " + BEGIN + " and " + END);
  }
  const size_t from = begin + std::string(BEGIN).size();
  text.replace(from, end - from,
               "\n" + pictureTable(rows, "sphere") + "\n" + pictureTable(rows, "cumulus") + "\n" +
                   pictureTable(rows, "les") + "\n" + pictureTable(rows, "les-single") + "\n" +
                   slabTable(rows) + "\n" + timeTable(rows));
  std::ofstream stream(page);
  stream << text;
  stream.flush();
  if (!stream) {
    throw std::runtime_error(page + ": cannot write");
  }
}

}  // namespace bench
