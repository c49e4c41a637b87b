// SPDX-License-Identifier: MIT
// The passes of one volume in one view: its light, and what the eye sees of it.
#pragma once

#include "frame/frame_commands.hpp"

namespace welkin {

// Throws NOT_PREPARED if a pipeline of the volume is missing; records nothing.
void findVolumePipelines(const FrameCommands& commands, const ViewTargets& targets,
                         const PlannedVolume& planned, bool first);

// Records a volume of the plan, drawn or not, and appends its lines to the statistics.
// `first`: no other volume or surface was recorded before it.
void recordVolume(FrameCommands& commands, const ViewTargets& targets, const PlannedVolume& planned,
                  bool first);

// Whether what one volume leaves in tiles in which it is seen is all that there is to composite:
// their list is in the view's volumeState.
bool onlyTilesSeen(const FrameCommands& commands, const ViewTargets& targets);

}  // namespace welkin
