#pragma once

#include "spectral/color.h"

namespace photopic {

/// CIEDE2000 with k_L = k_C = k_H = 1: Sharma, Wu, Dalal 2005, equations 2–22.
double delta_e_2000(const Lab& reference, const Lab& sample);

}  // namespace photopic
