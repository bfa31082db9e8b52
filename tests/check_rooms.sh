#!/bin/sh
# check_rooms.sh SOURCE: no room of a folder includes, directly or by way of others, one that includes it. A room and the
# rooms inside it are one; files beside the rooms are not looked at.
set -eu
cd "$1"
for folder in segmentation fitting solver registration pipeline; do
  circle=$(grep -rh --include='*.h' --include='*.cpp' -H "^#include \"$folder/" "$folder" |
    sed -E "s,^$folder/([^:]*):#include \"$folder/([^\"]*)\".*,\1 \2," |
    awk '{ a = $1; b = $2 } !sub("/[^/]*$", "", a) || !sub("/[^/]*$", "", b) { next }
         index(a "/", b "/") != 1 && index(b "/", a "/") != 1 { print a, b }' |
    tsort 2>&1 >/dev/null || true)
  if [ -n "$circle" ]; then
    echo "rooms of $folder include one another in a circle:"
    echo "$circle"
    exit 1
  fi
done
