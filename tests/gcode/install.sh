#!/usr/bin/env bash
# LinuxCNC's own interpreter, rs274, for the tests of G-code: two packages, unpacked and not installed.
# Usage: install.sh [FOLDER]; default: ~/.cache/drillctl-tests/rs274. Needs apt-get and dpkg.
set -euo pipefail
folder="${1:-${DRILLCTL_TEST_CACHE:-$HOME/.cache/drillctl-tests}/rs274}"
[ -x "$folder/usr/bin/rs274" ] && exit 0
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"
boost="$(apt-cache depends linuxcnc-uspace | sed -n 's/.*Depends: \(libboost-python[0-9.]*\)$/\1/p' | head -1)"
apt-get download -qq linuxcnc-uspace "$boost"
mkdir -p "$folder"
for package in *.deb; do
    dpkg -x "$package" "$folder"
done
