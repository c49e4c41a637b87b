// SPDX-License-Identifier: MIT
// Light of sky and ground on the volumes that a view draws.
#pragma once

#include "api/context.hpp"

namespace welkin {

// Finds it for each volume of the view's plan that is to have it, anew where it may have changed,
// and takes out those on which none falls.
void planAmbient(WlkContext_T& context, ViewState& view);

}  // namespace welkin
