#!/bin/sh
# SPDX-License-Identifier: MIT
# The tables of errors_*.c have a row for each error that a comment of accel.h promises, and no
# others: test_errors.sh BUILD
set -eu
out=$1/tests/unit/errors
mkdir -p "$out"
# accel.h, and those of the library that it includes.
headers=$("${CC:-cc}" -MM libaccel/accel.h | sed 's/^[^:]*://; s/\\$//')

# A comment is that of the functions that follow it, up to the next comment or empty line; of these
# only those of type int have errors.
# shellcheck disable=SC2086 # a list of files
awk '
/^\/\*/ { text = "" }
/^\/\*/, /\*\/$/ { text = text " " $0; next }
/^$/ { text = ""; next }
/^int accel_[a-z_]*\(/ {
	match($0, /accel_[a-z_]*\(/)
	name = substr($0, RSTART, RLENGTH - 1)
	rest = text
	while (match(rest, /-E[A-Z0-9]+/)) {
		print name, substr(rest, RSTART, RLENGTH)
		rest = substr(rest, RSTART + RLENGTH)
	}
}' $headers | sort -u >"$out/promised"

{
	sed -n 's/^\t{ "\(accel_[a-z_]*\)", \(-E[A-Z0-9]*\), .*/\1 \2/p' tests/unit/object/errors_*.c
	sed -n 's/^ \* \(accel_[a-z_]*\) \(-E[A-Z0-9]*\): .*/\1 \2/p' tests/unit/object/test_errors.c
} | sort -u >"$out/reached"

[ -s "$out/promised" ] || { echo "no errors in accel.h"; exit 1; }
diff -u --label "accel.h promises" "$out/promised" --label "tests reach" "$out/reached"
