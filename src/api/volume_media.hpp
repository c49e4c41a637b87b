// SPDX-License-Identifier: MIT
// What the light of all orders takes from the mixture of a volume's fields and from its optical
// depth, as contents change.
#pragma once

#include "api/context.hpp"

namespace welkin {

// Makes it anew for the volumes in which a field's share of the extinction, or the share of turns
// that follows from the depth, has changed by more than `most` since. 14 ms each the first time. A
// failure leaves each volume with the old or the new.
void renewMedia(WlkContext_T& context, double most);

}  // namespace welkin
