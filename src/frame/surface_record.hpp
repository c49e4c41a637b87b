// SPDX-License-Identifier: MIT
// The passes of one cloud surface in one view: its light maps, and what the eye sees of it.
#pragma once

#include "frame/frame_commands.hpp"

namespace welkin {

// Throws NOT_PREPARED if a pipeline of the surface is missing; records nothing.
void findSurfacePipelines(const FrameCommands& commands, const ViewTargets& targets,
                          const PlannedVolume& planned);

// Records a surface of the plan, drawn or not, and appends its lines to the statistics. `first`: no
// other volume or surface was recorded before it.
void recordSurface(FrameCommands& commands, const ViewTargets& targets,
                   const PlannedVolume& planned, bool first);

// Of a surface in a frame, at most: 4 of the shell, 9 of each of two light maps, 10 of what the eye
// sees.
constexpr uint32_t SURFACE_DISPATCHES = 32;
// Pictures of a surface that have constants of their own: along the light, along the vertical, the
// view's, and that of the cells of its detail.
constexpr uint32_t SURFACE_PICTURES = 4;

}  // namespace welkin
