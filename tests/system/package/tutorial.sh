#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Does what osgAnalyticBin/doc/tutorial.md says, word for word: takes its CMakeLists.txt and its shell commands, installs
# the build, and runs them in an empty folder. A viewer is ended by Escape when its window has been there for a while, as
# a user ends it. Every line of C++ that the text quotes has to
# stand in tutorial.cpp, and that has to stay within sixty lines.
# Arguments: source folder, build folder, scratch folder (emptied), library folder below a prefix.
set -eu

doc=$1/osgAnalyticBin/doc
build=$2
scratch=$3
libdir=$4

fail() {
    echo "tutorial.sh: $*" >&2
    exit 1
}

blocks() { # language of a fenced block
    awk -v fence="\`\`\`$1" '$0 == fence { on = 1; next } /^```/ { on = 0 } on' "$doc/tutorial.md"
}

rm -rf "$scratch"
mkdir -p "$scratch/work"
cmake --install "$build" --prefix "$scratch/prefix" >"$scratch/log" 2>&1 || {
    cat "$scratch/log" >&2
    fail "the build cannot be installed"
}

[ "$(wc -l <"$doc/tutorial.cpp")" -le 60 ] || fail "tutorial.cpp has more than 60 lines"
blocks cpp >"$scratch/quoted"
[ -s "$scratch/quoted" ] || fail "tutorial.md quotes nothing"
while IFS= read -r line; do
    grep -qxF -e "$line" "$doc/tutorial.cpp" || fail "not in tutorial.cpp: $line"
done <"$scratch/quoted"

cp "$doc/tutorial.cpp" "$scratch/work"
blocks cmake >"$scratch/work/CMakeLists.txt"
blocks sh >"$scratch/commands"
[ "$(wc -l <"$scratch/commands")" -ge 10 ] || fail "tutorial.md has too few commands"

unset LD_LIBRARY_PATH || true
export PATH="$scratch/prefix/bin:$PATH" CMAKE_PREFIX_PATH="$scratch/prefix" OSG_LIBRARY_PATH="$scratch/prefix/$libdir"
export OSG_WINDOW="0 0 320 240" LIBGL_ALWAYS_SOFTWARE=1
cd "$scratch/work"
cat >"$scratch/display" <<'EOF'
while :; do xdotool search --sync --onlyvisible --name "" >/dev/null 2>&1 && sleep 3 && xdotool mousemove 100 100 key Escape; done &
trap 'kill $!' EXIT
sh -eux "$1"
EOF
# A display number by process, for tests run side by side. A display that resets when the last window closes may miss
# the next.
timeout 300 xvfb-run -a -n $((6000 + $$ % 3000)) -s "-screen 0 640x480x24 -noreset" sh "$scratch/display" "$scratch/commands" >"$scratch/log" 2>&1 || {
    cat "$scratch/log" >&2
    fail "a command of tutorial.md failed"
}
# Both runs of the program, with and without the horizon.
grep -Eq "last frame: [1-9][0-9]* tiles tested, [1-9][0-9]* culled, [1-9][0-9]* of them behind" "$scratch/log" &&
    grep -Eq "last frame: [1-9][0-9]* tiles tested, [0-9]+ culled, 0 of them behind" "$scratch/log" || {
    cat "$scratch/log" >&2
    fail "the program did not say what its bins did"
}
! grep -iE "warning|unsupported|error" "$scratch/log" || fail "something complained"
