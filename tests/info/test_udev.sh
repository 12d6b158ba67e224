#!/bin/sh
# SPDX-License-Identifier: MIT
# The udev rule is for the boards that rtl/gloss.xml describes, and it has the name that messages
# give it.
set -eu
cd "$(dirname "$0")/../.."
rule=tools/udev/60-gloss.rules
failures=0

fail() {
	failures=$((failures + 1))
	echo "FAILED: $*"
}

# id NAME: four digits, as sysfs has them.
id() {
	value=$(sed -n "s/^#define GLOSS_USB_$1 \([0-9a-fx]*\)u$/\1/p" driver/gloss_regs.h)
	[ -n "$value" ] || fail "driver/gloss_regs.h has no GLOSS_USB_$1"
	printf '%04x' "$((value))"
}

# The rules are one, of one line, so that all it says holds for the board alone.
[ "$(grep -vc '^#' $rule)" -eq 1 ] || fail "not one rule"
for word in 'ACTION!="remove"' 'SUBSYSTEM=="usb"' 'ENV{DEVTYPE}=="usb_device"' \
	"ATTR{idVendor}==\"$(id VENDOR)\"" "ATTR{idProduct}==\"$(id PRODUCT)\"" \
	'ATTR{product}=="Gloss board"' 'GROUP="render"' 'MODE="0660"' 'TAG+="uaccess"'; do
	grep -v '^#' $rule | tr , '\n' | sed 's/^ *//' | grep -qxF "$word" || fail "no $word"
done
words=$(grep -v '^#' $rule | tr , '\n' | wc -l)
[ "$words" -eq 9 ] || fail "$words words, not those 9"

# What the library and the virtual board call the rule and the board.
for text in "60-gloss.rules:libaccel/transport/usb/node.c" "Gloss board:tools/vboard/usb/descriptors.c"; do
	grep -qF "${text%%:*}" "${text#*:}" || fail "no '${text%%:*}' in ${text#*:}"
done
# systemd-logind gives rights to tags that are set before its rule 73.
name=${rule##*/}
[ "${name%%-*}" -lt 73 ] || fail "after the rule that makes use of its tag"
[ "$failures" -eq 0 ]
