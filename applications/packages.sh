#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Installs the Debian 12 packages of a group that are missing, and those named as arguments. Before, it says which and
# why. Groups: demo (what applications/demo.sh needs), all (default: build, tests, documents, measurements, too).
#     sh applications/packages.sh [demo|all] [PACKAGE...]
set -eu

# Group, packages, what they are for.
groups="
demo | cmake g++ ninja-build | compile
demo | libopenscenegraph-dev openscenegraph libgl1-mesa-dri | OpenSceneGraph and its viewer
demo | libglm-dev libboost-dev libhwy-dev | headers of mathematics
demo | libgdal-dev proj-data | osgbindem reads elevation rasters
demo | libcli11-dev nlohmann-json3-dev | headers for command lines and JSON
demo | ferret-datasets libncarg-data | elevation data: the earth, Trinidad in Colorado
demo | xvfb xauth | a virtual display
all | ccache | keeps what was compiled for the next build
all | libopenmpi-dev openmpi-bin | osgbindem on several machines
all | libgtest-dev librapidcheck-dev libccd-dev libbenchmark-dev | tests and benchmarks
all | gdal-bin nginx pkg-config python3 xdotool | programs that tests run
all | ca-certificates clang-format doxygen git help2man | format, documents, man pages
all | libproj-dev | reference systems of photogrammetry sets
all | gnuplot-nox | diagrams
"

group=all
case ${1:-} in demo | all) group=$1 && shift ;; esac

is_installed() {
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null || true)" = installed ]
}

# Arguments: packages. Prints those that are missing, each after a space.
missing_of() {
    for package in "$@"; do
        is_installed "$package" || printf ' %s' "$package"
    done
}

missing=""
reasons=""
while IFS='|' read -r of packages reason; do
    [ "${of% }" = demo ] || [ "${of% }" = "$group" ] || continue
    # shellcheck disable=SC2086
    new=$(missing_of $packages)
    [ -n "$new" ] || continue
    missing="$missing$new"
    reasons="$reasons $new:$reason
"
done <<END
$(printf '%s' "$groups" | sed '/^$/d')
END
new=$(missing_of "$@")
if [ -n "$new" ]; then
    missing="$missing$new"
    reasons="$reasons $new: asked for
"
fi
if [ -z "$missing" ]; then
    echo "packages: all installed"
    exit 0
fi

printf 'packages: these are missing and are installed now:\n%s' "$reasons"
as_root=""
if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null 2>&1 || {
        echo "packages: run as root or install sudo" >&2
        exit 1
    }
    as_root="sudo"
fi

log=$(mktemp)
policy=""
trap 'rm -f "$log"; [ -z "$policy" ] || $as_root rm -f "$policy"' EXIT
run() {
    $as_root env DEBIAN_FRONTEND=noninteractive LC_ALL=C "$@" >"$log" 2>&1 || {
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
# apt answers no for itself and fails; what it would do stands in its last lines.
# shellcheck disable=SC2086
$as_root env LC_ALL=C apt-get install --no-install-recommends --assume-no $missing 2>&1 |
    sed -nE 's/^(Need to get .* of archives|After this operation.*)\.$/packages: \1/p'
# shellcheck disable=SC2086
run apt-get install -y --no-install-recommends $missing
! is_new nginx || run update-rc.d nginx disable
