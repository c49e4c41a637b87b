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
 *  - Functions that fail change nothing, and wlkGetLastError names the structure and the field.
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
