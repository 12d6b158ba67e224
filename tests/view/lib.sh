# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# What tests of gloss-view share; VIEW is its path. Every message is one line
# "gloss-view: what: where: what to do"; wrong use exits with 2, what fails with 1.
view=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cases=0 failures=0
# For what has to happen, in tenths of a second; GLOSS_SLOW: how many times slower this machine is.
patience=$((600 * ${GLOSS_SLOW:-1}))
unset DISPLAY WAYLAND_DISPLAY SDL_VIDEODRIVER

fail() {
	failures=$((failures + 1))
	echo "FAILED: $*"
	sed 's/^/    /' "$work/out" "$work/err" | head -n 20
}

# try COMMAND...: runs it, keeps what it says in out and err, and its status.
try() {
	cases=$((cases + 1))
	"$@" >"$work/out" 2>"$work/err"
	status=$?
}

# refused STATUS TEXT WHERE ARGUMENT...: exits with STATUS, after one line that starts with TEXT and
# names WHERE; says nothing else and writes no o.png.
refused() {
	expect=$1 text=$2 where=$3
	shift 3
	rm -f "$work/o.png"
	try "$view" "$@"
	[ "$status" -eq "$expect" ] || fail "gloss-view $*: exit $status, not $expect"
	[ "$(wc -l <"$work/err")" -eq 1 ] || fail "gloss-view $*: not one line"
	grep -q "^gloss-view: $text: .*: ..*" "$work/err" || fail "gloss-view $*: not '$text'"
	grep -qF -- "$where" "$work/err" || fail "gloss-view $*: does not name '$where'"
	[ ! -s "$work/out" ] || fail "gloss-view $*: prints"
	[ ! -e "$work/o.png" ] || fail "gloss-view $*: leaves a file"
}

# accepted ARGUMENT...: exits with 0 and complains of nothing.
accepted() {
	try "$view" "$@"
	[ "$status" -eq 0 ] || fail "gloss-view $*: exit $status"
	[ ! -s "$work/err" ] || fail "gloss-view $*: complains"
}

# same FILE FILE WHAT
same() {
	cmp -s "$1" "$2" || fail "$3"
}

# big_endian FILE OFFSET: a number of a PNG file's header.
big_endian() {
	od -An -tu1 -j "$2" -N 4 "$1" | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 }'
}

# is_png FILE WIDTH HEIGHT: from its first bytes to its last chunk.
is_png() {
	[ "$(od -An -tx1 -N 8 "$1" | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "$1: not a PNG file"
	[ "$(tail -c 8 "$1" | head -c 4)" = IEND ] || fail "$1: cut off"
	[ "$(big_endian "$1" 16)x$(big_endian "$1" 20)" = "$2x$3" ] || fail "$1: not $2x$3"
}

# interrupt PID: until it ends, for it may not listen yet; leaves its status in status.
interrupt() {
	cases=$((cases + 1))
	for _ in $(seq "$patience"); do
		kill -INT "$1" 2>/dev/null || break
		sleep 0.1
	done
	kill -KILL "$1" 2>/dev/null
	wait "$1"
	status=$?
}

nothing_left_in() {
	[ -z "$(find "$1" -name '*.png.*')" ] || fail "unfinished files in $1"
}

# finish: says how it went.
finish() {
	echo "gloss-view, $1: $cases cases, $failures failed"
	[ "$failures" -eq 0 ]
}
