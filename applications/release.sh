#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Makes what is published of a version, in the folder release: the source archive, the Debian packages, the pages of the
# documents, the zip for Windows, and SHA256SUMS. It publishes nothing. All files have to be committed, and CHANGELOG.md
# has to give the version's date.
#     sh applications/release.sh              # the zip only where an earlier one left its libraries in build/windows
#     sh applications/release.sh --windows    # the zip, too: 35 minutes more
#     sh applications/release.sh --source     # the source archive alone
# For one commit, each run makes the same source archive and pages. Packages differ with the compiler and with who makes
# them, the zip with each run.
set -eu
cd "$(dirname "$0")/.."

step() { echo "== $*"; }

fail() {
    echo "release.sh: $*" >&2
    exit 1
}

case ${1:-} in
    "" | --source | --windows) ;;
    -h | --help)
        sed -n '5,12s/^# //p' "$0"
        exit 0
        ;;
    *)
        echo "release.sh: \"$1\" is no argument, see sh applications/release.sh --help" >&2
        exit 2
        ;;
esac

version=$(sed -n 's/^ *VERSION \([0-9.]*\)$/\1/p' CMakeLists.txt)
name=osganalyticbin-$version
case $(grep -m 1 '^## ' CHANGELOG.md) in
    "## $version ("[0-9][0-9][0-9][0-9]-[0-9][0-9]-[0-9][0-9]")") ;;
    *) fail "CHANGELOG.md does not begin with \"## $version (YEAR-MONTH-DAY)\"" ;;
esac
changes=$(git status --porcelain)
[ -z "$changes" ] || fail "not committed: $(echo "$changes" | cut -c 4- | paste -s -d ' ')"
commit=$(git rev-parse HEAD)
tagged=$(git rev-parse -q --verify "refs/tags/v$version^{commit}" || true)
[ "${tagged:-$commit}" = "$commit" ] || fail "the tag v$version is another commit, $tagged: raise the version"

export LC_ALL=C
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
mkdir -p build
made=$(mktemp -d build/unfinished.XXXXXX)
trap 'rm -rf "$made"' EXIT
trap 'exit 130' HUP INT TERM

step "source archive of $commit"
git -c core.autocrlf=false -c tar.umask=0022 archive --prefix="$name/" -o "$made/$name.tar" HEAD
gzip -9n "$made/$name.tar"

if [ "${1:-}" != --source ]; then
    sh applications/packages.sh chromium

    step "Debian packages"
    sh applications/package.sh lint
    cp build/package/*.deb "$made"

    step "pages of the documents"
    cmake --build --preset package --target docs
    python3 tests/system/docs/pages.py build/package/docs/html chromium
    tar --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX \
        --transform="s|^html|$name-pages|" -C build/package/docs -cf "$made/$name-pages.tar" html
    gzip -9n "$made/$name-pages.tar"
fi

if [ "${1:-}" = --windows ] || { [ -z "${1:-}" ] && [ -e build/windows/deps/openscenegraph.done ]; }; then
    step "zip for Windows"
    sh applications/windows.sh
    cp build/windows/osganalyticbin-windows.zip "$made/$name-windows.zip"
fi

(cd "$made" && sha256sum -- *.* >SHA256SUMS)
chmod 755 "$made"
[ ! -e release ] || mv release "$made.old"
mv "$made" release
rm -rf "$made.old"

step "made in the folder release"
cat release/SHA256SUMS
case ${1:-} in
    --source) echo "Left out: Debian packages, pages, and the zip for Windows." ;;
    *) [ -e "release/$name-windows.zip" ] || echo "Left out: the zip for Windows; --windows makes it." ;;
esac
[ -n "$tagged" ] || echo "To tag it: git tag -a v$version -m 'osgAnalyticBin $version' $commit"
