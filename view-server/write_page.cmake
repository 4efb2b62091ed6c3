# SPDX-License-Identifier: MIT
# Writes one C++ file that holds the page's files as raw strings. FILES: separated by |.
string(REPLACE "|" ";" FILES "${FILES}")
set(text "// Written by write_page.cmake from the files it names.\n")
string(APPEND text "#include \"view-server/page.hpp\"\n\nnamespace splash::view {\n\n")
string(APPEND text "const std::vector<PageFile>& page_files() {\n  static const std::vector<PageFile> kFiles = {\n")
foreach(file ${FILES})
  file(READ ${file} body)
  file(RELATIVE_PATH name ${ROOT} ${file})
  string(APPEND text "      {\"${name}\", R\"__page__(${body})__page__\"},\n")
endforeach()
string(APPEND text "  };\n  return kFiles;\n}\n\n}  // namespace splash::view\n")
file(WRITE ${OUTPUT} "${text}")
