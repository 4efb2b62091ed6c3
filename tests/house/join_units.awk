# SPDX-License-Identifier: MIT
# Groups translation units that one compilation can read together: those with the same options that define no name twice
# at the left margin. In: "source <tab> options"; out: "options <tab> source <tab> source ..."; most: units in a group.
function find_names(file,   line, words, count) {
  split("", names)
  while ((getline line <file) > 0) {
    sub(/^#define /, "", line)
    sub(/^\[\[[a-z]*\]\] /, "", line)
    if (line !~ /^[A-Za-z]/ || line ~ /^(template|namespace|using namespace|extern|TEST|TYPED_TEST|INSTANTIATE|[a-z_]*:( |$))/) continue
    sub(/^MATCHER(_P[0-9]*)?\(/, "", line)
    sub(/^(class|struct|enum|enum class) /, "", line) && sub(/ .*/, "", line)
    sub(/[[({=;,].*/, "", line)
    count = split(line, words, " ")
    if (words[count] !~ /::/) names[words[count]] = 1
  }
  close(file)
}
function fits(group,   name) {
  if (options[group] != $2 || size[group] >= most) return 0
  for (name in names) if ((group, name) in taken) return 0
  return 1
}
BEGIN { FS = "\t" }
{
  find_names($1)
  for (group = 1; group <= groups && !fits(group); ++group) {}
  if (group > groups) { groups = group; options[group] = $2 }
  for (name in names) taken[group, name] = 1
  sources[group] = sources[group] "\t" $1
  ++size[group]
}
END { for (group = 1; group <= groups; ++group) print options[group] sources[group] }
