#!/usr/bin/env bash
# What the firmware tests need beside Python: the AVR simulator, a C compiler, and StandardFirmata as it is published.
# Usage: install.sh [FOLDER]; the firmware goes to FOLDER, by default ~/.cache/drillctl-tests. Needs root for apt-get.
set -euo pipefail
folder="${1:-${DRILLCTL_TEST_CACHE:-$HOME/.cache/drillctl-tests}}"
package="avrgirl-arduino@5.0.1" # it carries the unmodified programs as Intel hex, for Uno and Mega

if ! { [ -e /usr/include/simavr/sim_avr.h ] && command -v gcc; } >/dev/null; then
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends simavr libsimavr-dev libelf-dev gcc libc6-dev
fi

if [ ! -e "$folder/mega.hex" ] || [ ! -e "$folder/uno.hex" ]; then
    mkdir -p "$folder"
    work="$(mktemp -d)"
    trap 'rm -rf "$work"' EXIT
    archive="$(npm pack --silent --pack-destination "$work" "$package")"
    tar -xzf "$work/$archive" -C "$work" package/junk/hex
    for board in mega uno; do
        cp "$work/package/junk/hex/$board/StandardFirmata.cpp.hex" "$folder/$board.hex"
    done
fi
