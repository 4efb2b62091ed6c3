# SPDX-License-Identifier: MIT
# Run by splash_embed_kernels: writes one C++ file that holds kernel files as raw strings.
string(REPLACE "|" ";" FILES "${FILES}")
set(text "// Written by write_kernel_text.cmake from the files it names.\n")
string(APPEND text "#include \"sim-server/device/program.hpp\"\n\nnamespace splash::sim::kernels {\n\n")
string(APPEND text "std::vector<KernelSource> ${NAME}() {\n  return {\n")
foreach(file ${FILES})
  file(READ ${file} body)
  file(RELATIVE_PATH name ${ROOT} ${file})
  string(APPEND text "      {\"${name}\", R\"__kernel__(${body})__kernel__\"},\n")
endforeach()
string(APPEND text "  };\n}\n\n}  // namespace splash::sim::kernels\n")
file(WRITE ${OUTPUT} "${text}")
