#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Runs a command on a virtual display of its own: `sh tests/support/display.sh COMMAND...`. The exit code is the
# command's. xvfb-run itself may fail, before the command starts or after it has ended, where several displays come and
# go at once; it is tried again only where the command did not end.
set -u

code=$(mktemp)
trap 'rm -f "$code"' EXIT
number=$((100 + $$ % 5000)) # by process, so that tests may run side by side
for attempt in 1 2 3; do
    xvfb-run -a -n "$number" -s "-noreset -screen 0 640x480x24" \
        sh -c 'code=$1; shift; "$@"; echo $? >"$code"' display "$code" "$@"
    [ -s "$code" ] && exit "$(cat "$code")"
done
echo "display.sh: xvfb-run failed $attempt times" >&2
exit 1
