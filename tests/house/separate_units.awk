# SPDX-License-Identifier: MIT
# compile_commands.json in which each generated file of splash_joined (CMakeLists.txt) is replaced by the files that it
# includes, for tools that read one source at a time.
function print_entry(source,   command) {
  command = lines["command"]
  if (source != file) gsub(file, source, command)
  printf "%s{\n%s\n%s\n  \"file\": \"%s\"\n}", separator, lines["directory"], command, source
  separator = ",\n"
}
BEGIN { print "[" }
match($0, /^ *"[a-z]*": /) {
  key = substr($0, RSTART, RLENGTH)
  gsub(/[ ":]/, "", key)
  lines[key] = $0
}
key == "file" && /"file"/ {
  file = $0
  gsub(/^ *"file": "|",?$/, "", file)
  if (file !~ /_joined_[0-9]+\.cpp$/) { print_entry(file); next }
  while ((getline line <file) > 0) {
    gsub(/#include |"/, "", line)
    print_entry(line)
  }
  close(file)
}
END { print "\n]" }
