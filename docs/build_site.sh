#!/bin/sh
# build_site.sh BIN OUT: every page of the tree (docs/, the folders' READMEs) and a reference from what
# the programs in BIN say of themselves, as a site with search in OUT. Needs Debian's python3-sphinx,
# python3-myst-parser and python3-sphinx-rtd-theme.
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)
bin=$1
mkdir -p "$2"
out=$(cd "$2" && pwd)
pages=$out.pages
rm -rf "$pages"
mkdir -p "$pages"

# reference: one section a program with its --help, then every key of patient.toml
reference() {
  echo '# Reference: every program'
  printf '\nMade from what the programs say of themselves.\n'
  for program in "$bin"/mammotwin-*; do
    case $program in *-try-read) continue ;; esac  # other programs start it, no person does
    printf '\n## %s\n\n```text\n' "${program##*/}"
    "$program" --help || { echo "$program --help failed" >&2; exit 1; }
    echo '```'
  done
}

# The tree's pages and pictures stay where they are, so that links lead to the same places.
(cd "$top" && find README.md CONTRIBUTING.md docs segmentation fitting solver registration pipeline sample_data \
  tests/benchmarks tests/fuzz \( -name '*.md' -o -name '*.png' -o -name '*.css' -o -name 'conf.py' -o -path 'docs/measured/data/*.json' \) \
  -type f | while read -r file; do
  mkdir -p "$pages/$(dirname "$file")"
  cp "$file" "$pages/$file"
done)
mv "$pages/docs/conf.py" "$pages/conf.py"
reference > "$pages/docs/reference.md"

# contents CAPTION PAGE...: a list in the site's margin
contents() {
  printf '\n```{toctree}\n:hidden:\n:glob:\n:caption: %s\n\n' "$1"
  shift
  printf '%s\n' "$@" '```'
}
{
  contents 'Use it' tutorial how_to correct_segmentation add_mammograms read_ellipse questions glossary for_the_patient
  contents 'Look up' settings lesions_table reference
  contents 'How it works' theory ../segmentation/README ../fitting/README ../fitting/mesh/README ../solver/README \
    ../registration/README ../pipeline/README ../pipeline/report/README ../pipeline/slicer/README \
    ../pipeline/cohort/README ../pipeline/synthesize/README ../pipeline/install/README ../CONTRIBUTING
  contents 'What was measured' measured/README 'measured/[a-z]*' ../pipeline/evaluate/README ../pipeline/evaluate/registration/README \
    ../pipeline/evaluate/niftysim/README ../pipeline/evaluate/victre/README ../pipeline/validation/README \
    ../tests/benchmarks/README ../tests/fuzz/README 'measured/notes/*' ../sample_data/README '../sample_data/*/README'
} >> "$pages/docs/index.md"

sphinx-build -q -b html "$pages" "$out"
cat > "$out/index.html" <<'HTML'
<!DOCTYPE html><meta charset="utf-8"><title>Mammotwin</title>
<meta http-equiv="refresh" content="0; url=docs/index.html"><a href="docs/index.html">Mammotwin</a>
HTML
rm -rf "$pages"
echo "docs: $out/index.html"
