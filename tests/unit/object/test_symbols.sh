#!/bin/sh
# SPDX-License-Identifier: MIT
# The library exports the functions of accel.h, shared and static, and nothing else, and is C
# alone: test_symbols.sh BUILD
set -eu
build=$1
out=$build/tests/unit/symbols
mkdir -p "$out"

sed -n 's/^\t\(accel_[a-z_]*\);$/\1/p' libaccel/libaccel.map | sort >"$out/map"
"${CC:-cc}" -E -P libaccel/accel.h | grep -o '\baccel_[a-z_]*(' | tr -d '(' | sort -u >"$out/header"
nm -D --defined-only "$build/libaccel.so" | sed -n 's/.* T \(.*\)@@ACCEL_0$/\1/p' | sort >"$out/shared"
nm -D --defined-only "$build/libaccel.so" | grep -v ' T .*@@ACCEL_0$' |
	grep -v ' A ACCEL_0$' >"$out/shared-besides" || :
nm -g --defined-only "$build/libaccel.a" | sed -n 's/^[0-9a-f]* //p' | sed 's/^T //' |
	sort >"$out/static"

failed=0
for list in header shared static; do
	diff -u --label libaccel.map "$out/map" --label "$list" "$out/$list" || failed=1
done
if [ -s "$out/shared-besides" ]; then
	echo "exported besides:"
	cat "$out/shared-besides"
	failed=1
fi
needed=$(readelf -d "$build/libaccel.so" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
case $needed in
*stdc++*) echo "the library needs C++: $needed"; failed=1 ;;
esac
if ${MAKE:-make} -nB lib BUILD="$build" 2>&1 | grep -i -e 'c++' -e verilat; then
	echo "the library does not build with a C compiler alone"
	failed=1
fi
readelf -d "$build/libaccel.so" | grep -q 'SONAME.*\[libaccel.so.0\]' || { echo "no soname"; failed=1; }
exit $failed
