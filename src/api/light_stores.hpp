// SPDX-License-Identifier: MIT
// Which volumes keep their light for all views, and for how long.
#pragma once

#include "api/context.hpp"
#include "frame/light_store.hpp"

namespace welkin {

// Makes the stores that views ask for, as far as there is room for them, and lets go of others.
void prepareLightStores(WlkContext_T& context);

// Whether some or all volumes keep their light for this view.
void chooseStores(WlkContext_T& context, const ViewState& view, SceneFeatures& features);

// Hands stores of other shapes than those wanted to the frames that read them.
void retireLightStores(WlkContext_T& context, VolumeState& volume,
                       std::span<const LightStoreShape> wanted);

}  // namespace welkin
