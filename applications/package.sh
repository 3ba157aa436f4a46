#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Builds the Debian packages in build/package and says where they are. Asks nothing. Their maintainer is who runs this, as
# DEBFULLNAME and DEBEMAIL say it, or git.
# `sh applications/package.sh lint` looks at them with lintian too, and fails on errors and warnings.
set -eu
cd "$(dirname "$0")/.."

build=build/package
lint=${1:-}

sh applications/packages.sh dpkg-dev file help2man ${lint:+lintian}

# Debian's own flags (hardening, no folders of this machine in the binaries), and the time of the last commit.
CXXFLAGS="$(dpkg-buildflags --get CXXFLAGS) $(dpkg-buildflags --get CPPFLAGS)"
LDFLAGS=$(dpkg-buildflags --get LDFLAGS)
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}
export CXXFLAGS LDFLAGS SOURCE_DATE_EPOCH

rm -f "$build"/*.deb
cmake --preset package -DOSGANALYTICBIN_MAINTAINER="${DEBFULLNAME:-$(git config user.name)} <${DEBEMAIL:-$(git config user.email)}>"
cmake --build --preset package
(umask 022 && cd "$build" && cpack)

printf '\n== The packages; install them with: sudo apt install %s\n' "./$build/*.deb"
ls "$PWD/$build"/*.deb
[ -z "$lint" ] || lintian --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs "$build"/*.deb
