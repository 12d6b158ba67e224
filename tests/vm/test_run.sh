#!/bin/sh
# SPDX-License-Identifier: MIT
# What the launcher says without a machine: test_run.sh OUT
set -u
run=$(dirname "$0")/run
out=$1

fail() {
	echo "test_run: $1; it printed:" >&2
	cat "$out/said" >&2
	exit 1
}

# More than a pipe holds.
mkdir -p "$out/tests/vm"
seq -f 'user:test_%.0f' 3000 >"$out/tests/vm/list"

"$run" --build "$out" --list >"$out/listed" 2>"$out/said" || fail 'a list'
[ "$(wc -l <"$out/listed")" -eq 3000 ] || fail 'a list of all'
first=$("$run" --build "$out" --list 2>"$out/said" | head -n 1)
[ "${first%% *}" = test_1 ] || fail 'the first of a list'
[ ! -s "$out/said" ] || fail 'a list of which not all is read'
