#!/bin/sh
# SPDX-License-Identifier: MIT
# What gloss-view says of USB boards that are missing, not permitted or in use, to an ordinary user;
# and that they can be used again after.
set -u
work=$(mktemp -d)
chmod 755 "$work"
group=$(stat -c %g "$GLOSS_NODE_RTL")
holder=
failures=0

fail() {
	failures=$((failures + 1))
	echo "FAILED: $*"
	sed 's/^/    /' "$work/out" "$work/err"
}

# as_user GROUP PROGRAM ARGUMENT...: as user 1000, in GROUP besides its own.
as_user() {
	as=$1 program=$2
	shift 2
	setpriv --reuid 1000 --regid 1000 --groups "$as" "$GLOSS_BUILD/$program" "$@" \
		>"$work/out" 2>"$work/err"
	status=$?
}

# refused GROUP WHAT DEVICE REASON: one line, exit 1.
refused() {
	as_user "$1" gloss-view --device "$3" --size 64x64 --stats sphere:1
	[ "$status" -eq 1 ] || fail "$3: exit $status, not 1"
	[ "$(wc -l <"$work/err")" -eq 1 ] || fail "$3: not one line"
	grep -qxF "gloss-view: $2: ${3%:}: $4" "$work/err" || fail "$3: not '$4'"
	[ ! -s "$work/out" ] || fail "$3: prints"
}

# usable DEVICE
usable() {
	as_user "$group" gloss-info --device "$1"
	[ "$status" -eq 0 ] || fail "$1: exit $status"
}

# listed DEVICE PATTERN: a line of gloss-info --list.
listed() {
	as_user "$group" gloss-info --list
	[ "$status" -eq 0 ] || fail "gloss-info --list: exit $status"
	grep -qx "$1  *$2" "$work/out" || fail "gloss-info --list: no '$1', '$2'"
}

# sysfs DEVICE: what sysfs has of it, by its serial number.
sysfs() {
	for file in /sys/bus/usb/devices/*/serial; do
		[ "$(cat "$file")" != "${1##*/}" ] || break
	done
	echo "${file%/*}"
}

# node DEVICE: its node in /dev.
node() {
	device=$(sysfs "$1")
	printf '/dev/bus/usb/%03d/%03d' "$(cat "$device/busnum")" "$(cat "$device/devnum")"
}

rtl=$GLOSS_USB_RTL model=$GLOSS_USB_MODEL
rtl_node=$(node "$rtl") model_node=$(node "$model")
trap 'chmod 660 $rtl_node $model_node; [ -z "$holder" ] || kill -KILL $holder; rm -rf "$work"' EXIT

usable "usb:/${model##*/}"
place=$(sysfs "$model")
usable "usb:${place##*/}"
grep -q "${model##*/}" "$work/out" || fail "usb:${place##*/} is not $model"

# ---- names ----

refused "$group" 'can not open device' "${rtl}X" \
	"there is no board ${rtl}X; gloss-info --list shows those that are there"
refused "$group" 'can not open device' usb:1d6b:0f02 \
	'no Gloss board 1d6b:0f02 on USB; lsusb shows what is plugged in'
refused "$group" 'no such device' usb:RTL0 \
	'name a board as in usb:1209:0001/SERIAL, usb:/SERIAL, usb:1-2 (its bus and port) or usb:'

# ---- not permitted ----

# denied NODE
denied() {
	echo "not permitted: $1; install 60-gloss.rules, as make install does, and plug the board in again"
}

refused 1000 'can not open device' "$rtl" "$(denied "$rtl_node")"
chmod 600 "$model_node"
refused "$group" 'can not open device' "$model" "$(denied "$model_node")"
listed usb:1209:0001 "$(denied "$model_node")"
usable usb:
chmod 660 "$model_node"

# ---- in use ----

SDL_VIDEODRIVER=dummy "$GLOSS_BUILD/gloss-view" --device "$model" --size 64x64 --window sphere:1 &
holder=$!
# Claimed, an interface has usbfs for its driver. To try to open it might be to get ahead.
claimed=$(sysfs "$model"):1.0/driver
for _ in $(seq 600); do
	[ ! -e "$claimed" ] || break
	sleep 0.1
done
refused "$group" 'can not open device' "$model" "$model is in use by another program"
listed "$model" 'Gloss USB board .*'
kill -INT $holder
wait $holder
holder=
usable "$model"

# ---- none on the bus ----

host=$(realpath /sys/bus/usb/devices/usb1)
host=${host%/usb1}
driver=$(realpath "$host/driver")
echo "${host##*/}" >"$driver/unbind"
refused "$group" 'can not open device' usb: \
	'no Gloss board 1209:0001 on USB; lsusb shows what is plugged in'
as_user "$group" gloss-info --list
grep -q '^usb:' "$work/out" && fail 'boards without a bus'
echo "${host##*/}" >"$driver/bind"
for _ in $(seq 600); do
	as_user "$group" gloss-info --list
	[ "$(grep -c '^usb:.*Gloss USB board' "$work/out")" -lt 2 ] || break
	sleep 0.1
done
rtl_node=$(node "$rtl") model_node=$(node "$model")
usable "$rtl"
usable "$model"

echo "$failures failures"
[ "$failures" -eq 0 ]
