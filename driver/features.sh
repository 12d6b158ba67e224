#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-only
# Finds what this kernel's headers offer: features.sh TABLE HEADER COMPILER FLAG...
# Each line of TABLE that compiles is defined in HEADER as GLOSS_HAVE_<name>.
# Distributions move features between kernel versions, so no version is asked for.
set -eu
table=$1 header=$2
shift 2

# Only what makes a call or a member wrong may fail a test, never a mere warning.
compile() {
	"$@" -Wno-error -Werror=implicit-function-declaration -Werror=incompatible-pointer-types \
		-Werror=int-conversion -fsyntax-only -x c -
}

snippet() {
	printf '#include <%s>\nvoid probe(void);\nvoid probe(void)\n{\n\t%s\n}\n' "$1" "$2"
}

# Without this a compiler that always fails would look like a kernel that has nothing.
snippet drm/drm_drv.h 'struct drm_driver driver = { .name = "gloss" }; (void)driver;' |
	compile "$@" || {
	echo "features.sh: not even a simple file compiles with these headers" >&2
	exit 1
}

{
	echo '/* SPDX-License-Identifier: GPL-2.0-only */'
	echo '/* What these kernel headers offer. Made by features.sh from features.table. */'
	grep -v '^#' "$table" | while read -r name include code; do
		if snippet "$include" "$code" | compile "$@" 2>/dev/null; then
			echo "#define GLOSS_HAVE_$name"
		else
			echo "/* no GLOSS_HAVE_$name */"
		fi
	done
} >"$header.new"
mv "$header.new" "$header"
