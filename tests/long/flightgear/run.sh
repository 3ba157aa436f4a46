#!/bin/sh
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
#
# Builds the flight over FlightGear's scenery and runs it: tests/README.md. Installs Debian's SimGear and base data, some
# 2 GB, for which it has to be root the first time. Arguments are those of the program.
set -e
cd "$(dirname "$0")/../../.."
packages="libsimgear-dev flightgear-data-base libudns-dev libopenal-dev libexpat1-dev libcurl4-openssl-dev liblzma-dev"
# shellcheck disable=SC2086
dpkg -s $packages >/dev/null 2>&1 || apt-get install -y --no-install-recommends $packages
cmake --preset edit -DOSGANALYTICBIN_FLIGHTGEAR=ON
cmake --build --preset edit --target osganalyticbin_flightgear
exec xvfb-run -a -s "-screen 0 1280x1024x24" build/edit/bin/osganalyticbin_flightgear "$@"
