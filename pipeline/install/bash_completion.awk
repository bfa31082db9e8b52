# bash_completion.awk: the text of --help -> completion of its options, targets and settings in bash.
# Variable: program.

/^  [^ ]/ {
  split($1, names, ",")
  for (i in names) {
    word = names[i]
    if (is_front_door) sub(/=.*/, "=", word)
    if (word ~ /^--[a-z]/ || (is_front_door && word ~ /^[A-Za-z-]+=?$/)) words[++count] = word
  }
}
/^Targets:$/ { is_front_door = 1 }
END {
  printf "complete -o default -W '"
  for (i = 1; i <= count; i++) printf "%s%s", (i > 1 ? " " : ""), words[i]
  printf "' %s\n", program
}
