# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Completion for bash. Options and materials come from gloss-view --help, boards from
# gloss-info --list, so that they are those there are.

_gloss_view_files()
{
	compopt -o filenames 2>/dev/null
	mapfile -t COMPREPLY < <(
		compgen -d -- "$1"
		if [ $# -eq 1 ]; then
			compgen -W 'sphere torus cube plane' -- "$1"
			compgen -f -- "$1"
		fi
		for ending in "${@:2}"; do
			compgen -f -X "!*$ending" -- "$1"
		done | sort -u
	)
}

_gloss_view()
{
	local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words

	# A colon parts words for readline, unless bash-completion is there to mend it.
	if declare -F _get_comp_words_by_ref >/dev/null; then
		_get_comp_words_by_ref -n : -c current -p before
	fi
	case $before in
	--device)
		words="auto drm: usb: model: sim: $(gloss-info --list 2>/dev/null | sed 's/  .*//')" ;;
	--shading)
		words='gouraud adaptive quadratic flat' ;;
	--material)
		words=$("$1" --help 2>/dev/null | sed -n 's/^Materials: \(.*\)\.$/\1/p' | tr -d ,) ;;
	--up)
		words='x y z -x -y -z' ;;
	--light)
		words='direction: point: spot:' ;;
	--out | -o | --compare)
		_gloss_view_files "$current" .png .ppm
		return ;;
	--size | --ambient | --diffuse | --specular | --shininess | --crease | --rotate | --camera | \
		--zoom | --fov | --background | --turntable)
		COMPREPLY=()
		return ;;
	*)
		if [[ $current != -* ]]; then
			_gloss_view_files "$current"
			return
		fi
		words="-h -o $("$1" --help 2>/dev/null | sed -n 's/^  \(--[a-z-]*\).*/\1/p')" ;;
	esac
	mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
	if declare -F __ltrim_colon_completions >/dev/null; then
		__ltrim_colon_completions "$current"
	fi
}

complete -F _gloss_view gloss-view
