#!/bin/sh
# check_site.sh SOURCE BIN: the documentation site is made without a warning. 77 (skipped) where Sphinx is not installed.
set -eu
command -v sphinx-build >/dev/null || exit 77
site=$(mktemp -d)
trap 'rm -r "$site" "$site.pages" 2>/dev/null || true' EXIT
"$1/docs/build_site.sh" "$2" "$site" >"$site/said" 2>&1 || { cat "$site/said"; exit 1; }
[ -s "$site/docs/tutorial.html" ] && [ -s "$site/docs/reference.html" ]
! grep -E 'WARNING|ERROR' "$site/said"
