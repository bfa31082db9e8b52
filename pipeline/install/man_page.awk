# man_page.awk: the text of --help -> a manual page. Variables: program, version.
# Sections are lines that end in ":"; an entry is a line indented by two, its explanation stands two or
# more blanks after it or on the lines below, indented further.

function escaped(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  return (text ~ /^[.']/ ? "\\&" : "") text
}

NR == 1 {
  summary = $0
  sub(/^[^:]*: */, "", summary)
  printf ".TH %s 1 \"\" \"Mammotwin %s\" \"User Commands\"\n", toupper(program), version
  printf ".SH NAME\n%s \\- %s\n", escaped(program), escaped(summary)
  next
}
/^Usage: / {
  usage = $0
  sub(/^Usage: [^ ]* */, "", usage)
  printf ".SH SYNOPSIS\n.B %s\n%s\n", escaped(program), escaped(usage)
  next
}
/^[A-Z][A-Za-z ]*:$/ {
  print ".SH " toupper(substr($0, 1, length($0) - 1))
  next
}
/^  [^ ]/ {
  entry = substr($0, 3)
  at = match(entry, /   *[^ ]/)
  print ".TP"
  print ".B " escaped(at ? substr(entry, 1, at - 1) : entry)
  if (at) {
    text = substr(entry, at)
    sub(/^ */, "", text)
    print escaped(text)
  }
  next
}
/[^ ]/ {
  sub(/^ */, "")
  print escaped($0)
}
END {
  print ".SH EXIT STATUS"
  print "0 done, 1 the data are not fit for it, 2 wrong use, 3 not converged."
  print ".SH SEE ALSO"
  print ".BR mammotwin (1)"
}
