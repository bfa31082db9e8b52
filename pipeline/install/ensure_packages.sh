#!/bin/sh
# ensure_packages.sh [LIST...]: installs the Debian packages of the lists (default: debian_packages.txt) that are
# missing, saying first which.
set -eu
[ $# -gt 0 ] || set -- debian_packages.txt
cd "$(dirname "$0")"

missing=
for package in $(cat "$@"); do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "These packages are missing and installing them needs root or sudo:$missing" >&2
    exit 1
  }
  as_root=sudo
fi
echo "Installing Debian packages:$missing" >&2
$as_root apt-get update -q=2
# shellcheck disable=SC2086 # one word a package
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q=2 --no-install-recommends $missing >/dev/null
