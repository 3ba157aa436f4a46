#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Builds the fuzz targets with clang and runs each for so many minutes (default 1): sh tests/fuzz/run.sh [MINUTES]
# What fails is left in build/fuzz/findings; new inputs are kept in build/fuzz/corpus. Exit code: 0 if nothing failed.
set -eu
minutes=${1:-1}
case $minutes in '' | *[!0-9]*) echo "run.sh: \"$minutes\" is no whole number of minutes" >&2; exit 2 ;; esac
cd "$(dirname "$0")/../.."
mkdir -p build
command -v clang++ >/dev/null || { echo "run.sh: no clang++; apt-get install clang" >&2; exit 2; }

targets="options storedtext index camerapath raster"
cmake -S . -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DOSGANALYTICBIN_SANITIZE=ON -DOSGANALYTICBIN_FUZZ=ON >build/fuzz-configure.log ||
    { cat build/fuzz-configure.log >&2; exit 1; }
for target in $targets; do cmake --build build/fuzz --target "osganalyticbin_fuzz_$target"; done

# OpenSceneGraph and GDAL keep singletons to the end.
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
failed=0
for target in $targets; do
    mkdir -p "build/fuzz/corpus/$target" build/fuzz/findings
    echo "-- $target, $minutes min"
    "build/fuzz/bin/osganalyticbin_fuzz_$target" -max_total_time=$((minutes * 60)) -timeout=20 -rss_limit_mb=2048 \
        -print_final_stats=1 -verbosity=0 -close_fd_mask=1 -artifact_prefix="build/fuzz/findings/$target-" \
        "build/fuzz/corpus/$target" "tests/fuzz/seeds/$target" || failed=1
done
[ $failed = 0 ] || echo "failures: build/fuzz/findings" >&2
exit $failed
