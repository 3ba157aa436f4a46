#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Runs a command on its own virtual display: `sh tests/support/display.sh COMMAND...`. The exit code is that of the
# command. When several displays start and stop at once, xvfb-run may fail before the command starts or after it has
# ended. The script tries again only if the command did not end.
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
