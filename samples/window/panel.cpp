// SPDX-License-Identifier: MIT
#include "panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdio>

namespace {

constexpr float WIDTH = 380.0f;  // of the panel, pixels
constexpr const char* SCREENSHOT = "welkin.png";

float milliseconds(uint64_t nanoseconds) {
  return static_cast<float>(nanoseconds) * 1e-6f;
}

// A slider's value counts when the user lets go of it: each makes tables and pipelines.
bool released() {
  return ImGui::IsItemDeactivatedAfterEdit();
}

bool drawQuality(Settings& settings) {
  bool changed = false;
  int level = static_cast<int>(settings.quality);
  if (ImGui::Combo("quality", &level, "low\0medium\0high\0ultra\0")) {
    settings.quality = static_cast<uint32_t>(level);
    changed = true;
  }
  bool budget = settings.timeBudget_ms > 0.0f;
  if (ImGui::Checkbox("keep a time budget", &budget)) {
    settings.timeBudget_ms = budget ? 33.0f : 0.0f;
    changed = true;
  }
  if (budget) {
    ImGui::SliderFloat("budget, ms", &settings.timeBudget_ms, TIME_BUDGETS_ms.least,
                       TIME_BUDGETS_ms.most, "%.1f",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    changed = released() || changed;
  }
  return changed;
}

bool drawClouds(Settings& settings) {
  ImGui::SliderFloat("droplets, um", &settings.dropletDiameter_um, DROPLET_DIAMETERS_um.least,
                     DROPLET_DIAMETERS_um.most, "%.1f", ImGuiSliderFlags_AlwaysClamp);
  bool changed = released();
  ImGui::SliderFloat("extinction, 1/m", &settings.cloudExtinction, CLOUD_EXTINCTIONS.least,
                     CLOUD_EXTINCTIONS.most, "%.3f",
                     ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  changed = released() || changed;
  return changed;
}

}  // namespace

void Panel::addFrame(float milliseconds) {
  times_ms_[static_cast<size_t>(next_)] = milliseconds;
  next_ = (next_ + 1) % static_cast<int>(times_ms_.size());
}

void Panel::drawTimes() const {
  const float most = *std::max_element(times_ms_.begin(), times_ms_.end());
  const int last =
      (next_ + static_cast<int>(times_ms_.size()) - 1) % static_cast<int>(times_ms_.size());
  char text[48];
  std::snprintf(text, sizeof text, "frame %.1f ms, most %.1f",
                double{times_ms_[static_cast<size_t>(last)]}, double{most});
  ImGui::PlotLines("##times", times_ms_.data(), static_cast<int>(times_ms_.size()), next_, text,
                   0.0f, most * 1.2f, ImVec2(ImGui::GetContentRegionAvail().x, 60.0f));
}

// Every pass with its time or the reason why it was left out.
void Panel::drawPasses(const FrameReport& report) {
  ImGui::Text("Welkin %.2f ms, estimated error %.1f %%", double{totalTime(report)},
              100.0 * double{report.relativeError});
  ImGui::Text("%u dispatches, %u draws, %u barriers, %.1f MiB", report.frame.dispatches,
              report.frame.draws, report.frame.barriers,
              static_cast<double>(report.frame.deviceMemory) / (1 << 20));
  if (report.quality.control != WLK_CONTROL_LEVEL) {
    ImGui::Text("rung %u of %u to %u: %s", report.quality.rung, report.quality.lowestRung,
                report.quality.highestRung, shortReason(report.quality));
  }
  if (!ImGui::BeginTable("passes", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV)) {
    return;
  }
  ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch, 2.0f);
  ImGui::TableSetupColumn("commands", ImGuiTableColumnFlags_WidthStretch, 1.0f);
  ImGui::TableSetupColumn("ms, or why not", ImGuiTableColumnFlags_WidthStretch, 2.0f);
  ImGui::TableHeadersRow();
  for (const WlkPassStats& pass : report.passes) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(pass.name);
    ImGui::TableNextColumn();
    ImGui::Text("%u", pass.commands);
    ImGui::TableNextColumn();
    if (pass.recorded != 0) {
      ImGui::Text("%.2f", double{milliseconds(pass.gpuTime_ns)});
    } else {
      ImGui::TextDisabled("%s", shortReason(pass));
    }
  }
  ImGui::EndTable();
}

PanelRequest Panel::draw(Settings& settings, const FrameReport& report, bool ownClouds) {
  PanelRequest request;
  ImGui::SetNextWindowPos(ImVec2(8.0f, 8.0f), ImGuiCond_FirstUseEver);
  // As high as what it shows, or as the window.
  ImGui::SetNextWindowSizeConstraints(ImVec2(WIDTH, 0.0f),
                                      ImVec2(WIDTH, ImGui::GetIO().DisplaySize.y - 16.0f));
  if (!ImGui::Begin("Welkin (F1)", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
    ImGui::End();
    return request;
  }
  auto hour = static_cast<float>(settings.hour);
  if (ImGui::SliderFloat("hour", &hour, HOURS.least, HOURS.most, "%.2f",
                         ImGuiSliderFlags_AlwaysClamp)) {
    settings.hour = double{hour};
  }
  if (ownClouds) {
    request.clouds = drawClouds(settings);
  }
  request.quality = drawQuality(settings);
  drawTimes();
  if (report.ready) {
    drawPasses(report);
  }
  if (ImGui::Button("screenshot")) {
    request.screenshot = SCREENSHOT;
  }
  ImGui::InputTextWithHint("##scene", "scene.json", sceneFile_.data(), sceneFile_.size());
  ImGui::SameLine();
  if (ImGui::Button("load")) {
    request.scene = sceneFile_.data();
  }
  if (!message_.empty()) {
    ImGui::TextWrapped("%s", message_.c_str());
  }
  ImGui::End();
  return request;
}
