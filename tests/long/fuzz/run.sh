#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Builds fuzz targets (default: all) with clang and runs each for so many minutes (default 1):
#   sh tests/long/fuzz/run.sh [MINUTES [TARGET...]]
# What fails is left in build/fuzz/findings; new inputs are kept in build/fuzz/corpus. Exit code: 0 if nothing failed.
set -eu
minutes=${1:-1}
case $minutes in '' | *[!0-9]*) echo "run.sh: \"$minutes\" is no whole number of minutes" >&2; exit 2 ;; esac
cd "$(dirname "$0")/../../.."
mkdir -p build
command -v clang++ >/dev/null || { echo "run.sh: no clang++; apt-get install clang" >&2; exit 2; }

all="options storedtext index packed tiles arguments camerapath"
[ $# -lt 1 ] || shift
[ $# -gt 0 ] || set -- $all
for target in "$@"; do
    case " $all " in *" $target "*) ;; *) echo "run.sh: no target \"$target\"; give some of: $all" >&2; exit 2 ;; esac
done

cmake --preset fuzz >build/fuzz-configure.log 2>&1 || { cat build/fuzz-configure.log >&2; exit 1; }
for target in "$@"; do cmake --build --preset fuzz --target "osganalyticbin_fuzz_$target"; done

# OpenSceneGraph and GDAL keep singletons to the end.
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
failed=0
for target in "$@"; do
    mkdir -p "build/fuzz/corpus/$target" build/fuzz/findings
    echo "-- $target, $minutes min"
    "build/fuzz/bin/osganalyticbin_fuzz_$target" -max_total_time=$((minutes * 60)) -timeout=20 -rss_limit_mb=2048 \
        -print_final_stats=1 -verbosity=0 -close_fd_mask=1 -artifact_prefix="build/fuzz/findings/$target-" \
        "build/fuzz/corpus/$target" "tests/long/fuzz/seeds/$target" || failed=1
done
[ $failed = 0 ] || echo "failures: build/fuzz/findings" >&2
exit $failed
