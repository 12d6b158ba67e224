#!/bin/sh
# SPDX-License-Identifier: MIT
# Which kernels tests/vm/kernels finds on a machine, and what it says of others: test_kernels.sh OUT
set -u
kernels=$(dirname "$0")/kernels
out=$1
failed=0
GLOSS_ROOT=$out/root
export GLOSS_ROOT

image() {
	mkdir -p "$GLOSS_ROOT/boot" "$GLOSS_ROOT/lib/modules/$1/kernel"
	: >"$GLOSS_ROOT/boot/vmlinuz-$1"
}

headers() {
	mkdir -p "$GLOSS_ROOT/lib/modules/$1/build"
	: >"$GLOSS_ROOT/lib/modules/$1/build/Makefile"
}

fail() {
	echo "test_kernels: $1; it printed:" >&2
	cat "$out/found" "$out/said" >&2
	failed=1
}

# finds NAME EXPECTED MESSAGE ARGUMENT...: a MESSAGE of "" is silence
finds() {
	name=$1 expected=$2 message=$3
	shift 3
	"$kernels" "$@" >"$out/found" 2>"$out/said" || fail "$name"
	[ "$(tr '\n' ' ' <"$out/found")" = "$expected" ] || fail "$name"
	if [ -n "$message" ]; then
		grep -qF "$message" "$out/said" || fail "$name: not '$message'"
	else
		[ ! -s "$out/said" ] || fail "$name: not silent"
	fi
}

# refuses NAME MESSAGE ARGUMENT...
refuses() {
	name=$1 message=$2
	shift 2
	! "$kernels" "$@" >"$out/found" 2>"$out/said" || fail "$name"
	[ ! -s "$out/found" ] || fail "$name"
	grep -qF "$message" "$out/said" || fail "$name: not '$message'"
}

rm -rf "$out"
mkdir -p "$out"
refuses no_kernel_at_all 'no Linux 6.12 to boot and build for; install linux-image-6.12-amd64'

image 6.12.9-amd64
headers 6.12.9-amd64
finds debian_13_has_one '6.12 ' 'no Linux 6.1 to boot and build for; install linux-image-amd64'

image 6.1.0-9-amd64
headers 6.1.0-9-amd64
finds both_newest_first '6.12 6.1 ' ''
finds releases '6.12.9-amd64 6.1.0-9-amd64 ' '' --release
finds one_of_them '6.1 ' '' 6.1
finds in_the_order_asked_for '6.1 6.12 ' '' 6.1 6.12
finds by_release '6.12 ' '' 6.12.9-amd64

image 6.12.117+deb13-amd64
finds a_newer_one_without_headers_is_passed_over '6.12.9-amd64 6.1.0-9-amd64 ' '' --release
headers 6.12.117+deb13-amd64
finds numbers_are_not_letters '6.12.117+deb13-amd64 ' '' --release 6.12

image 6.16.3+deb13-amd64
finds what_is_missing_of_a_newer_series '6.12 6.1 ' \
	'no Linux 6.16 to boot and build for; install linux-headers-6.16.3+deb13-amd64'
refuses a_series_without_headers 'install linux-headers-6.16.3+deb13-amd64' 6.16
headers 6.16.3+deb13-amd64
finds a_newer_series '6.16 6.12 6.1 ' ''

for other in 5.10.0-30-amd64 6.17.1-cloud-amd64 6.17.1-rt-amd64 6.17.1-gloss; do
	image $other
	headers $other
done
finds no_older_one_and_no_flavour '6.16 6.12 6.1 ' ''
refuses a_series_that_is_not_there 'no Linux 6.5 to boot and build for' 6.5
exit $failed
