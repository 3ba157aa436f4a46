#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Installs what is missing, builds, and runs all tests: release (programs, with each public header by itself, and the
# installed package, as others use it), dev (unit tests of the libraries, with assertions and sanitizers), tsan (those of
# threads), and a program with static libraries, without Highway. `sh tests/run.sh quick` runs the release build alone, with
# all unit tests.
# Tests are skipped, and listed, when something that they need is missing. With OSGANALYTICBIN_REQUIRE_ALL=ON they fail.
set -eu

case ${1:-} in
    "" | quick) ;;
    -h | --help)
        sed -n '5,9s/^# //p' "$0"
        exit 0
        ;;
    *)
        echo "run.sh: \"$1\" is no argument, see sh tests/run.sh --help" >&2
        exit 2
        ;;
esac

cd "$(dirname "$0")/.."
jobs=$(nproc 2>/dev/null || echo 2)
# Tests wait for servers, displays and pagers.
test_jobs=$((jobs + 1))

step() { echo "== $*"; }

build() { # preset, then more arguments of cmake --build
    preset=$1
    shift
    step "build $preset"
    cmake --preset "$preset" -DOSGANALYTICBIN_REQUIRE_ALL="${OSGANALYTICBIN_REQUIRE_ALL:-OFF}" \
        -DOSGANALYTICBIN_SANITIZED_TESTS="$sanitized_tests" >"build/$preset.configure.log" 2>&1 || { cat "build/$preset.configure.log" >&2; exit 1; }
    cmake --build --preset "$preset" "$@" -- -j "$jobs" >"build/$preset.build.log" 2>&1 ||
        { tail -n 60 "build/$preset.build.log" >&2; exit 1; }
}

test_preset() { # preset, then more arguments of ctest
    preset=$1
    shift
    step "test $preset"
    ctest --preset "$preset" -j "$test_jobs" --timeout 600 --no-tests=error --progress "$@"
}

sh applications/packages.sh
mkdir -p build

step "format"
git ls-files '*.cpp' '*.h' 2>/dev/null | xargs -r clang-format --dry-run --Werror

step "layers"
python3 tests/system/layers/layers.py .

sanitized_tests=OFF
if [ "${1:-}" = quick ]; then sanitized_tests=ON; fi
build release --target all all_verify_interface_header_sets
test_preset release
if [ "${1:-}" = quick ]; then exit 0; fi

sanitized_tests=ON
build dev
test_preset dev -LE 'soundness|pictures|threads|http'
build tsan --target osganalyticbin_threads_tests osgdb_serializers_osganalyticbin
test_preset tsan -L threads
build static --target osgAnalyticBinViewer osgAnalyticBinMappings
step "a static kit and viewer library, as others use them"
sh tests/system/package/buildtree.sh "$PWD" "$PWD/build/static" "$PWD/build/static/buildtree"

step "all tests passed"
