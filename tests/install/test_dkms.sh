#!/bin/sh
# SPDX-License-Identifier: MIT
# DKMS builds driver/ for each kernel that is named, from a copy and in a tree of its own, so that it
# takes no root and leaves nothing: test_dkms.sh OUT RELEASE...
set -eu
out=$1
shift

command -v dkms >/dev/null || {
	echo 'skip: no dkms; install dkms (make deps)'
	exit 77
}
name=$(sed -n 's/^PACKAGE_NAME="\(.*\)"/\1/p' driver/dkms.conf)
version=$(sed -n 's/^PACKAGE_VERSION="\(.*\)"/\1/p' driver/dkms.conf)

rm -rf "$out"
mkdir -p "$out/tree" "$out/src"
out=$(cd "$out" && pwd)
cp -r driver "$out/src/$name-$version"

# As apt runs it, not as make does. What is built is not signed, so that no key is made in /var.
build() {
	env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL sign_file="$out/none" mok_signing_key="$out/key" \
		mok_certificate="$out/certificate" dkms build "$name/$version" -k "$1" \
		--dkmstree "$out/tree" --sourcetree "$out/src" >"$out/log" 2>&1
}

for release; do
	if ! build "$release"; then
		cat "$out/log" "$out/tree/$name/$version/build/make.log" >&2 2>/dev/null || true
		echo "test_dkms: not built for $release" >&2
		exit 1
	fi
	module=$(find "$out/tree/$name/$version/$release" -name "$name.ko*")
	found=$(PATH=$PATH:/sbin:/usr/sbin modinfo -F vermagic "$module")
	[ "${found%% *}" = "$release" ] || {
		echo "test_dkms: $module is for '$found', not $release" >&2
		exit 1
	}
	echo "$name $version, $release: built"
done
