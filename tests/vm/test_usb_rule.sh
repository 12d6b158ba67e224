#!/bin/sh
# SPDX-License-Identifier: MIT
# udev itself reads the rule, and gives the board's node to group render and to whoever is logged in;
# nothing else on the bus.
set -eu
command -v udevadm >/dev/null || {
	echo "skip: no udevadm (package udev)"
	exit 77
}
rules=/run/udev/rules.d
mkdir -p $rules
cp "$GLOSS_SOURCE/tools/udev/60-gloss.rules" $rules/
trap 'rm -rf $rules' EXIT

# node SYSFS
node() {
	printf '/dev/bus/usb/%03d/%03d' "$(cat "$1/busnum")" "$(cat "$1/devnum")"
}

# The last VALUE that a rule gave to KEY.
rule_says() {
	sed -n "s/.*\.rules:[0-9]* $1 \([0-9]*\)\$/\1/p" /tmp/udev.log | tail -n 1
}

# Applies the rules to the device at SYSFS, whose node is nobody's before, and prints whose then.
# Since systemd 257 udevadm only tells what it would do to the node.
apply() {
	udevadm test --action=add "$1" >/tmp/udev.log 2>&1
	mode=$(rule_says MODE) group=$(rule_says GROUP)
	chmod "${mode:-600}" "$(node "$1")"
	chgrp "${group:-0}" "$(node "$1")"
	stat -c '%A %U %G' "$(node "$1")"
}

failures=0 boards=0
for file in /sys/bus/usb/devices/*/product; do
	device=$(realpath "${file%/*}")
	now=$(apply "$device")
	tagged=$(grep -c ':uaccess:' /tmp/udev.log || :)
	echo "$(cat "$file"): $now, $tagged lines with the tag"
	if [ "$(cat "$file")" = "Gloss board" ]; then
		boards=$((boards + 1))
		[ "$now" = "crw-rw---- root render" ] && [ "$tagged" -gt 0 ] && continue
	else
		[ "$tagged" -eq 0 ] && [ "${now##* }" != render ] && continue
	fi
	sed 's/^/    /' /tmp/udev.log
	failures=$((failures + 1))
done
[ $boards -eq 2 ] && [ $failures -eq 0 ]
