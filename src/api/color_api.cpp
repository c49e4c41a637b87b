// SPDX-License-Identifier: MIT
// wlkGetColorMatrix: what views multiply their radiance with.
#include <algorithm>

#include "api/error.hpp"
#include "api/validate.hpp"
#include "frame/uniforms.hpp"

using namespace welkin;

WlkResult wlkGetColorMatrix(uint32_t colorSpace, double matrix[9]) {
  return guarded([&] {
    if (colorSpace > WLK_COLOR_LINEAR_SRGB) {
      fail(WLK_ERROR_INVALID_ARGUMENT, 0, "colorSpace", "colorSpace is %u, expected WLK_COLOR_*",
           colorSpace);
    }
    checkPointer(matrix, "matrix");
    const ColorRows rows = colorRows(colorSpace);
    for (size_t row = 0; row < rows.size(); ++row) {
      for (size_t column = 0; column < rows.size(); ++column) {
        matrix[3 * column + row] = static_cast<double>(rows[row][column]);
      }
    }
    return WLK_SUCCESS;
  });
}
