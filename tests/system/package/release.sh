#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# What applications/release.sh refuses, and the source archive that it makes, in a small project with its own history.
# Arguments: source folder, scratch folder (emptied).
set -eu

source=$1
scratch=$2
export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_NOSYSTEM=1
export GIT_AUTHOR_NAME=A GIT_AUTHOR_EMAIL=a@example.org GIT_COMMITTER_NAME=A GIT_COMMITTER_EMAIL=a@example.org
export GIT_AUTHOR_DATE='2020-02-02T02:02:02Z' GIT_COMMITTER_DATE='2020-02-02T02:02:02Z'
unset GIT_DIR GIT_WORK_TREE || true

fail() {
    echo "release.sh: $*" >&2
    cat "$scratch/log" >&2
    exit 1
}

makes() { sh applications/release.sh --source >"$scratch/log" 2>&1 || fail "failed"; }

refuses() { # a pattern of the only line that it prints
    ! sh applications/release.sh --source >"$scratch/log" 2>&1 || fail "does not refuse: $1"
    [ "$(wc -l <"$scratch/log")" = 1 ] || fail "more than one line: $1"
    grep -q "^release.sh: $1" "$scratch/log" || fail "does not say: $1"
}

heading() { # a version, and the text in parentheses after it
    sed "0,/^## .*/s//## $1 ($2)/" "$source/CHANGELOG.md" >CHANGELOG.md
    git commit -q -a -m "$1 $2"
}

rm -rf "$scratch"
mkdir -p "$scratch/project"
cd "$scratch/project"
git init -q
cp -r "$source/applications" "$source/CMakeLists.txt" "$source/CHANGELOG.md" "$source/.gitignore" .
version=$(sed -n 's/^ *VERSION \([0-9.]*\)$/\1/p' CMakeLists.txt)
git add .
git commit -q -m "Begin"

echo "== it refuses a version without a date, and the date of another version"
heading "$version" unreleased
refuses "CHANGELOG.md does not begin with \"## $version (YEAR-MONTH-DAY)\""
heading 99.1 2020-02-02
refuses "CHANGELOG.md"
heading "$version" 2020-02-02

echo "== it refuses what is not committed"
touch new.cpp
refuses "not committed: new.cpp"
rm new.cpp
echo >>CMakeLists.txt
refuses "not committed: CMakeLists.txt"
git checkout -q CMakeLists.txt
[ ! -e release ] || fail "refused, and made something"

echo "== it makes a source archive of all files, with the commit's date"
makes
[ "$(ls release)" = "SHA256SUMS
osganalyticbin-$version.tar.gz" ] || fail "other files in the folder release"
(cd release && sha256sum --quiet -c SHA256SUMS) || fail "wrong checksums"
tar -xzf "release/osganalyticbin-$version.tar.gz" -C "$scratch"
git ls-files >"$scratch/committed"
(cd "$scratch/osganalyticbin-$version" && find . -type f | sed 's|^\./||' | LC_ALL=C sort) >"$scratch/archived"
cmp "$scratch/committed" "$scratch/archived" || fail "not the committed files"
[ -z "$(find "$scratch/osganalyticbin-$version" ! -newermt 2020-02-02T02:02:01Z -o -newermt 2020-02-02T02:02:03Z)" ] ||
    fail "other dates"

echo "== a clone makes the same, whatever its settings"
git clone -q . "$scratch/clone"
(cd "$scratch/clone" && git config tar.umask user && umask 077 && sleep 1 && makes)
cmp release/SHA256SUMS "$scratch/clone/release/SHA256SUMS" || fail "other checksums"

echo "== a tag of this commit may exist, one of another may not"
git tag "v$version"
makes
echo >>CMakeLists.txt
git commit -q -a -m "More"
refuses "the tag v$version is another commit"
cmp release/SHA256SUMS "$scratch/clone/release/SHA256SUMS" || fail "refused, and changed the folder release"
git tag -d "v$version" >/dev/null

echo "== when a step fails, the folder release stays as it was"
mkdir "$scratch/bin"
printf '#!/bin/sh\nexit 3\n' >"$scratch/bin/sha256sum"
chmod +x "$scratch/bin/sha256sum"
! PATH="$scratch/bin:$PATH" sh applications/release.sh --source >"$scratch/log" 2>&1 || fail "goes on without sums"
cmp release/SHA256SUMS "$scratch/clone/release/SHA256SUMS" || fail "failed, and changed the folder release"
[ -z "$(ls build)" ] || fail "left in build: $(ls build)"
[ -z "$(git status --porcelain)" ] || fail "leaves files that git does not ignore"

echo "== it says how it is used"
sh applications/release.sh --help >"$scratch/log"
grep -q "sh applications/release.sh --windows  *#" "$scratch/log" || fail "no example"
! sh applications/release.sh --everything >"$scratch/log" 2>&1 || fail "takes any argument"
