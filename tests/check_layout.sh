#!/bin/sh
# check_layout.sh TOP: names the files below TOP that are not as .clang-format has them.
set -eu
cd "$1"
command -v clang-format >/dev/null || {
  echo "skipped: there is no clang-format (package clang-format)"
  exit 77
}
folders='segmentation fitting solver registration pipeline tests'
# shellcheck disable=SC2086 # one word a folder
differ=$(find $folders -name '*.h' -o -name '*.cpp' | sort | xargs clang-format --dry-run 2>&1 |
  sed -n 's/^\([^:]*\):.*clang-format-violations.*/\1/p' | sort -u)
[ -z "$differ" ] || {
  echo "Not as .clang-format has them (clang-format -i mends it):"
  echo "$differ"
  exit 1
}
