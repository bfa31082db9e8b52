# Sourced by the scripts here: which names a patient may have.

# A plain name, so that it is safe in paths, commands, tables and links.
is_plain_name() {
  case "$1" in
    '' | *[!A-Za-z0-9._-]* | [!A-Za-z0-9]*) return 1 ;;
  esac
}

is_kept_name() {
  case "$1" in
    evaluation | gel_* | cohort.* | cohort_* | failed.tsv | lesions.tsv) return 0 ;;
  esac
  return 1
}
