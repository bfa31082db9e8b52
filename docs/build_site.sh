#!/bin/sh
# build_site.sh BIN OUT: the pages of this folder, and a reference from what the programs in BIN say of
# themselves, as a site of plain HTML in OUT. Needs Debian's cmark-gfm.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
bin=$1
out=$2
mkdir -p "$out"

# reference: one section a program with its --help, then every key of patient.toml
reference() {
  echo '# Reference'
  echo
  echo 'Made from what the programs say of themselves.'
  for program in "$bin"/mammotwin-*; do
    printf '\n## %s\n\n```\n' "${program##*/}"
    "$program" --help
    echo '```'
  done
  printf '\n## patient.toml\n\n'
  "$bin/mammotwin-segment" --list-settings
}

# page NAME < markdown: OUT/NAME.html
page() {
  {
    sed "s/TITLE/$1/" "$here/head.html"
    cmark-gfm --unsafe -e table -e autolink | sed 's/href="\([a-z_]*\)\.md"/href="\1.html"/g'
    echo '</main></body></html>'
  } > "$out/$1.html.new"
  mv "$out/$1.html.new" "$out/$1.html"
}

for source in "$here"/*.md; do
  name=${source##*/}
  page "${name%.md}" < "$source"
done
reference > "$out/reference.md.new"
page reference < "$out/reference.md.new"
rm "$out/reference.md.new"
echo "docs: $out/index.html"
