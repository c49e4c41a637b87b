// SPDX-License-Identifier: MIT
// What the estimate of a view's error is made from.
#pragma once

#include "api/context.hpp"
#include "frame/error_estimate.hpp"

namespace welkin {

// `volumes` by PlannedVolume::index. Allocates only if `bodies`, which the result refers to, has no
// room for all volumes.
ErrorInput errorInput(const WlkContext_T& context, const ViewState& view, const PlanInput& input,
                      const Plan& plan, std::span<const RecordVolume> volumes,
                      std::pmr::vector<ErrorVolume>& bodies);

}  // namespace welkin
