# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Sourced by the scripts beside it: repository root, lavapipe as the only Vulkan device, build step.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 1

say() { printf '\n== %s\n' "$*"; }

# Software rendering everywhere: results and exact counts are those of one known driver, also on a
# machine with a GPU. Set WELKIN_ANY_DEVICE=1 to let the loader find the machine's own devices.
use_lavapipe() {
  local json
  if [[ -n ${WELKIN_ANY_DEVICE:-} ]]; then
    return
  fi
  json=$(find /usr/share/vulkan/icd.d -name 'lvp_icd*.json' 2>/dev/null | head -n 1)
  if [[ -z $json ]]; then
    echo "no lavapipe driver found: install mesa-vulkan-drivers" >&2
    return 1
  fi
  # The second name is the one that loaders before 1.3.207 know.
  export VK_DRIVER_FILES=$json VK_ICD_FILENAMES=$json
}

# build PRESET [TARGET]...: configures and builds; all targets if none is named.
build() {
  local preset=$1
  shift
  if command -v ccache >/dev/null; then
    # As its manual asks for precompiled headers, which it would refuse otherwise.
    local sloppy=pch_defines,time_macros,include_file_mtime,include_file_ctime
    export CMAKE_C_COMPILER_LAUNCHER=ccache
    export CMAKE_CXX_COMPILER_LAUNCHER="env;CCACHE_SLOPPINESS=$sloppy;ccache"
  fi
  cmake --preset "$preset" --log-level=WARNING &&
    cmake --build --preset "$preset" ${1:+--target "$@"}
}
