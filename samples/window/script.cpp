// SPDX-License-Identifier: MIT
#include "script.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "values.hpp"

namespace {

using Deed = std::function<void(Settings&, PanelRequest&)>;

std::string readFile(const std::string& value) {
  if (value.empty()) {
    throw std::invalid_argument("expected a file");
  }
  return value;
}

Deed setHour(const std::string& value) {
  return [hour = double{readNumber(value, HOURS)}](Settings& settings, PanelRequest&) {
    settings.hour = hour;
  };
}

Deed setDroplets(const std::string& value) {
  return [diameter_um = readNumber(value, DROPLET_DIAMETERS_um)](Settings& settings,
                                                                 PanelRequest& request) {
    settings.dropletDiameter_um = diameter_um;
    request.clouds = true;
  };
}

Deed setExtinction(const std::string& value) {
  return [extinction = readNumber(value, CLOUD_EXTINCTIONS)](Settings& settings,
                                                             PanelRequest& request) {
    settings.cloudExtinction = extinction;
    request.clouds = true;
  };
}

Deed setQuality(const std::string& value) {
  const auto level = qualityLevels().find(value);
  if (level == qualityLevels().end()) {
    throw std::invalid_argument("expected low, medium, high or ultra");
  }
  return [quality = level->second](Settings& settings, PanelRequest& request) {
    settings.quality = quality;
    request.quality = true;
  };
}

Deed setBudget(const std::string& value) {
  return [budget_ms = value == "off" ? 0.0f : readNumber(value, TIME_BUDGETS_ms)](
             Settings& settings, PanelRequest& request) {
    settings.timeBudget_ms = budget_ms;
    request.quality = true;
  };
}

Deed loadScene(const std::string& value) {
  return [file = readFile(value)](Settings&, PanelRequest& request) { request.scene = file; };
}

Deed takeScreenshot(const std::string& value) {
  return [file = readFile(value)](Settings&, PanelRequest& request) { request.screenshot = file; };
}

Deed resizeWindow(const std::string& value) {
  return [size = readSize(value)](Settings&, PanelRequest& request) { request.size = size; };
}

Deed printReport(const std::string& value) {
  if (!value.empty()) {
    throw std::invalid_argument("expected no value");
  }
  return [](Settings&, PanelRequest& request) { request.report = true; };
}

struct Kind {
  const char* key;
  const char* value;  // for people
  Deed (*make)(const std::string& value);
};

constexpr std::array KINDS{Kind{"hour", "=HOURS", setHour},
                           Kind{"droplets", "=MICROMETRES", setDroplets},
                           Kind{"extinction", "=PER_METRE", setExtinction},
                           Kind{"quality", "=LEVEL", setQuality},
                           Kind{"budget", "=MILLISECONDS|off", setBudget},
                           Kind{"scene", "=FILE", loadScene},
                           Kind{"screenshot", "=FILE", takeScreenshot},
                           Kind{"size", "=WIDTHxHEIGHT", resizeWindow},
                           Kind{"report", "", printReport}};

}  // namespace

std::string actionHelp() {
  std::string text;
  for (const Kind& kind : KINDS) {
    text += (text.empty() ? "" : ", ") + std::string(kind.key) + kind.value;
  }
  return text;
}

Action parseAction(const std::string& text) {
  uint64_t frame = 0;
  const char* end = text.data() + text.size();
  const auto [colon, error] = std::from_chars(text.data(), end, frame);
  if (error != std::errc() || colon == end || *colon != ':' || frame == 0) {
    throw std::invalid_argument("expected FRAME:ACTION, frames counted from 1");
  }
  const std::string rest(colon + 1, end);
  const size_t equals = std::min(rest.find('='), rest.size());
  const std::string key = rest.substr(0, equals);
  const auto* kind = std::find_if(KINDS.begin(), KINDS.end(),
                                  [&](const Kind& candidate) { return key == candidate.key; });
  if (kind == KINDS.end()) {
    throw std::invalid_argument("expected one of " + actionHelp());
  }
  return {frame, kind->make(equals == rest.size() ? "" : rest.substr(equals + 1))};
}

Action screenshotAt(uint64_t frame, const std::string& file) {
  return {frame, takeScreenshot(file)};
}

Script::Script(std::vector<Action> actions) : actions_(std::move(actions)) {
  std::stable_sort(actions_.begin(), actions_.end(),
                   [](const Action& a, const Action& b) { return a.frame < b.frame; });
}

const Action* Script::next(uint64_t frame) {
  return done_ < actions_.size() && actions_[done_].frame <= frame ? &actions_[done_++] : nullptr;
}
