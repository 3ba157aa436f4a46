#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Installs every Debian 12 package that the build, the tests and the demo need, and those named as arguments, if one is
# missing.
set -eu

packages="
  ca-certificates ccache clang-format cmake doxygen g++ git help2man ninja-build pkg-config python3
  libopenscenegraph-dev openscenegraph libglm-dev
  libgdal-dev libproj-dev gdal-bin proj-data libcli11-dev nlohmann-json3-dev
  libopenmpi-dev openmpi-bin
  libgtest-dev librapidcheck-dev libboost-dev libhwy-dev libbenchmark-dev libccd-dev
  xvfb xauth libgl1-mesa-dri nginx gnuplot-nox
  ferret-datasets libncarg-data
"

missing=""
for package in $packages "$@"; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing="$missing $package"
done
if [ -z "$missing" ]; then
    echo "packages: all installed"
    exit 0
fi

as_root=""
if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null 2>&1 || {
        echo "packages: missing$missing; run as root or install sudo" >&2
        exit 1
    }
    as_root="sudo"
fi

echo "packages: installing$missing"
export DEBIAN_FRONTEND=noninteractive
log=$(mktemp)
policy=""
trap 'rm -f "$log"; [ -z "$policy" ] || $as_root rm -f "$policy"' EXIT
run() {
    $as_root env DEBIAN_FRONTEND=noninteractive "$@" >"$log" 2>&1 || {
        cat "$log" >&2
        echo "packages: \"$*\" failed" >&2
        exit 1
    }
}

# nginx serves files to tests alone: where it is new, no web server is started, now or at the next boot.
is_new() { case " $missing " in *" $1 "*) true ;; *) false ;; esac; }
if is_new nginx && [ ! -e /usr/sbin/policy-rc.d ]; then
    policy=/usr/sbin/policy-rc.d
    printf '#!/bin/sh\nexit 101\n' | $as_root tee "$policy" >/dev/null
    $as_root chmod 755 "$policy"
fi
run apt-get update
# shellcheck disable=SC2086
run apt-get install -y --no-install-recommends $missing
! is_new nginx || run update-rc.d nginx disable
