#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Uses the build folder as the installed package is used: with its programs on PATH, where find_package looks, and with
# its name in osgAnalyticBin_DIR.
# Arguments: source folder, build folder, scratch folder (emptied).
set -eu

source=$1
build=$2
scratch=$3
unset CMAKE_PREFIX_PATH osgAnalyticBin_DIR || true

fail() {
    echo "buildtree.sh: $*" >&2
    exit 1
}

quietly() { # runs a command and shows what it said only when it fails
    "$@" >"$scratch/log" 2>&1 || {
        cat "$scratch/log" >&2
        fail "failed: $*"
    }
}

rm -rf "$scratch"
mkdir -p "$scratch"

# viewer brings kit with it
echo "== find_package with the programs on PATH"
PATH="$build/bin:$PATH" quietly cmake -S "$source/tests/system/consumer" -B "$scratch/path" -G Ninja \
    "-DCONSUMER_COMPONENTS=core;viewer;mappings"
grep -q "osgAnalyticBin_DIR:PATH=$build/" "$scratch/path/CMakeCache.txt" || fail "another package was found"
quietly cmake --build "$scratch/path"
ctest --test-dir "$scratch/path" --output-on-failure --no-tests=error

echo "== component core without OpenSceneGraph and Boost"
quietly cmake -S "$source/tests/system/consumer" -B "$scratch/core" -G Ninja -DosgAnalyticBin_DIR="$build/osgAnalyticBin" \
    -DCONSUMER_COMPONENTS=core -DCMAKE_DISABLE_FIND_PACKAGE_OpenSceneGraph=ON -DCMAKE_DISABLE_FIND_PACKAGE_Boost=ON
quietly cmake --build "$scratch/core"
