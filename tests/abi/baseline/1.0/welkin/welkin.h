/* SPDX-License-Identifier: MIT
 *
 * Welkin: atmosphere middleware for game engines. C API, core part: no Vulkan type appears here.
 *
 * Conventions, stated once:
 *  - SI units (metre, radian, 1/metre) unless a name says otherwise (`dropletDiameter_um`).
 *  - World space is the engine's, right- or left-handed, in metres, double precision.
 *  - Directions are unit vectors; a light's direction points *towards* the light.
 *  - RGB means the three wavelengths 680, 550, 440 nm ([R04] Table 3), linear, scene-referred.
 *  - Radiance has the unit of the light's irradiance per steradian.
 *  - Matrices are column-major and act on column vectors (unless the field says row-major).
 *  - Every structure starts with sType, structSize, next; fill it with wlkInitStruct, which sets
 *    these three and the defaults named below, then change what you need.
 *  - Handles are values; {0} is null; a stale handle gives WLK_ERROR_INVALID_HANDLE, never a crash.
 *    A context alone is a pointer: it must be null or alive.
 *  - Functions that fail change nothing and leave what they would fill as it was, but for
 *    wlkCreateContext, which writes null, wlkPrepare and wlkVulkanCmd..., see there.
 *    wlkGetLastError names the structure and the field at fault.
 *  - Every function may return INVALID_ARGUMENT for null pointers and values out of their ranges,
 *    INVALID_HANDLE, UNKNOWN_STRUCT and STRUCT_TOO_NEW for the heads of structures, and
 *    OUT_OF_HOST_MEMORY; those that need the context's device DEVICE_LOST once it is lost; further
 *    errors are named at each.
 *  - Setters of planet, sky, absorber, fog, ambient light, aerial perspective, a surface's detail
 *    and a field's image take null for what there is at first, wlkSetLights with a count of 0;
 *    others refuse it.
 *
 * Growth, within a major version:
 *  - Structures get fields at their ends, whose 0 is what was before; callers' older, shorter
 *    structures (structSize, and strides of arrays) stay welcome. A newer caller's longer one is
 *    taken if what this library does not know is 0.
 *  - What wlkInitStruct writes into a field, and what numbers mean, stays. Pictures of a quality
 *    level may get better or faster; the CHANGELOG says so.
 *  - Expect new values where the library answers: WlkResult, WLK_REASON_*, WLK_PASS_*,
 *    WLK_CONTROL_REASON_*, WLK_APPROXIMATION_*, WLK_LOG_ID_*.
 *  - Values, flag bits and chained structures that this library does not know are refused.
 *  - Reserved fields are 0: others are refused (INVALID_ARGUMENT), and 0 is written.
 *
 * Thread classes, named at each function:
 *  [F] free: any thread, any time.
 *  [C] context: one thread at a time per context.
 *
 * Sources: [R04] Riley et al. 2004, [J23] Jendersie & d'Eon 2023, [B08] Bouthors et al. 2008.
 */
#ifndef WELKIN_WELKIN_H
#define WELKIN_WELKIN_H

#include "core.h"
#include "output.h"
#include "query.h"
#include "scene.h"
#include "statistics.h"
#include "surface.h"
#include "view.h"

#endif
