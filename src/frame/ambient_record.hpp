// SPDX-License-Identifier: MIT
// Turns the light of sky and ground inside one volume into commands: computed where it is not known
// yet, and shown to a view's eye.
#pragma once

#include "frame/frame_commands.hpp"

namespace welkin {

// `viewUniforms`: range of the volume's constants in this view. Counts towards the pass `stats`,
// which will be the next line of the statistics. Leaves its own descriptor set bound, and ends with
// a barrier for shaders.
void recordAmbient(FrameCommands& commands, const PlannedVolume& planned, VkDeviceSize viewUniforms,
                   WlkPassStats& stats);

}  // namespace welkin
