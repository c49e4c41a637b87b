// SPDX-License-Identifier: MIT
// A context's cloud surfaces between the API and the frames.
#pragma once

#include "api/context.hpp"

namespace welkin {

// Makes the light maps that views ask for, and hands those that none asks for any more to the
// frames that use them.
void prepareSurfaceLights(WlkContext_T& context);

// Hands all that a surface has on the device to the frames that use it.
void retireSurface(WlkContext_T& context, SurfaceState& surface);

// Records the copies of meshes and tables that wait. Throws nothing if `context.retired` has room
// for two more entries than there are surfaces.
void uploadSurfaces(WlkContext_T& context, VkCommandBuffer commands);

// Whether nothing waits to be copied.
bool surfacesUploaded(const WlkContext_T& context);

// The surfaces as the plan and the recording of a view want them.
void gatherSurfaces(WlkContext_T& context, ViewState& view, PlanInput& input);

}  // namespace welkin
