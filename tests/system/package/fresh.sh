#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Tries the Debian packages as a new user would, in a new Debian 12: installs them with apt, runs the stock osgviewer and
# osgconv without any environment variable, follows the tutorial, purges the packages, and looks for what they left.
# By hand, as root: needs debootstrap and the network, and what `sh applications/package.sh` made.
# Argument: folder of the new root, which is made unless it is there.
set -eu

root=$1
source=$(cd "$(dirname "$0")/../../.." && pwd)

fail() {
    echo "fresh.sh: $*" >&2
    exit 1
}

ls "$source"/build/package/*.deb >/dev/null 2>&1 || fail "no packages; run sh applications/package.sh first"
# the archive that this machine installs from
archive=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Release: bookworm' | head -n 1)
[ -d "$root/etc" ] || debootstrap --variant=minbase bookworm "$root" "$archive"
cp /etc/resolv.conf "$root/etc/resolv.conf"
mount -t proc proc "$root/proc"
trap 'umount "$root/proc"' EXIT

inside() { # a shell command in the new root, with an environment that holds nothing
    env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
        chroot "$root" sh -euc "$1" >"$root/tmp/log" 2>&1 || {
        cat "$root/tmp/log" >&2
        fail "failed in the new root: $1"
    }
}

said() { grep -q -e "$1" "$root/tmp/log" || { cat "$root/tmp/log" >&2; fail "not said: $1"; }; }

rm -rf "$root/tmp/packages" "$root/tmp/work"
mkdir -p "$root/tmp/packages" "$root/tmp/work"
cp "$source"/build/package/*.deb "$root/tmp/packages"
cp "$source/osgAnalyticBin/doc/tutorial.cpp" "$root/tmp/work"
block() { awk -v fence="\`\`\`$1" '$0 == fence { on = 1; next } /^```/ { on = 0 } on' "$source/osgAnalyticBin/doc/tutorial.md"; }
block cmake >"$root/tmp/work/CMakeLists.txt"
block sh >"$root/tmp/work/commands"

echo "== a Debian with OpenSceneGraph and a virtual display"
inside "apt-get update; apt-get install -y --no-install-recommends openscenegraph xvfb xauth libgl1-mesa-dri"

echo "== library and programs"
inside "apt-get install -y --no-install-recommends /tmp/packages/libosganalyticbin0_*.deb /tmp/packages/openscenegraph-plugin-analyticbin_*.deb \
    /tmp/packages/osganalyticbin-tools_*.deb"
! grep -q libopenmpi "$root/tmp/log" || fail "the programs need MPI"
inside "osgconv --format analyticbin"
said "method=quadratic"
programs="osgbinviewer osgbindem osgbinconv osgbinbench"
inside "for p in $programs; do \$p --version; done; ldconfig -p"
for program in $programs; do said "^$program (osgAnalyticBin)"; done
said "libosgAnalyticBin.so.0"
said "libosgAnalyticBinViewer.so.0"

# Displays of the machine itself are not seen from the new root: a number of its own.
display="xvfb-run -a -n $((20000 + $$ % 9000)) -s '-screen 0 640x480x24 -noreset'"

echo "== osgbinviewer shows a globe and records, the stock osgviewer shows it too"
inside "cd /tmp/work; export OSG_RUN_FRAME_COUNT=5 LIBGL_ALWAYS_SOFTWARE=1
    $display osgbinviewer 3.proceduralglobe --record flight.path
    $display osgviewer 3.proceduralglobe.analyticbin; cat flight.path"
said "^[0-9.]* [-0-9.e+]* "
! grep -iE "could not find plugin|warning|error" "$root/tmp/log" || fail "something complained"

echo "== development files, and the tutorial word for word"
inside "apt-get install -y --no-install-recommends /tmp/packages/libosganalyticbin-dev_*.deb cmake make g++ pkg-config"
inside "cd /tmp/work; export OSG_RUN_FRAME_COUNT=20 LIBGL_ALWAYS_SOFTWARE=1; $display sh -eux commands"
said "last frame: [1-9][0-9]* tiles tested, [1-9][0-9]* culled"
! grep -iE "could not find plugin|unsupported|error" "$root/tmp/log" || fail "something complained"
inside "pkg-config --cflags --libs osgAnalyticBinViewer"
said "losgAnalyticBinViewer"

echo "== purge"
inside "apt-get purge -y libosganalyticbin0 libosganalyticbin-dev openscenegraph-plugin-analyticbin osganalyticbin-tools; ldconfig"
left=$(find "$root" -xdev -path "$root/tmp" -prune -o -path "$root/proc" -prune -o -iname '*osganalyticbin*' -print \
    -o -name 'osgdb_*bin*' -newer "$root/tmp/packages" -print)
[ -z "$left" ] || fail "left behind: $left"
! grep -il osganalyticbin "$root/var/lib/dpkg/status" || fail "dpkg still knows the packages"
echo "everything worked, and nothing was left"
