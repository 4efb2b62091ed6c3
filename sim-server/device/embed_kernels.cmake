# SPDX-License-Identifier: MIT
# splash_embed_kernels(target out_name FILES...): compiles OpenCL C files, and what they include,
# into `target` as text, so that a program is one file and finds its kernels wherever it is installed.
# Gives `splash::sim::kernels::<out_name>()`: each file once, behind those that it includes, as
# KernelSource. Included files are named from the source tree's root.
set(SPLASH_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/write_kernel_text.cmake)

function(splash_embed_kernels target out_name)
  set(files "")
  foreach(file ${ARGN})
    file(REAL_PATH ${file} file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND files ${file})
  endforeach()
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${out_name}_kernels.cpp)
  string(REPLACE ";" "|" joined "${files}")
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DNAME=${out_name} -DOUTPUT=${output} "-DFILES=${joined}"
            -DROOT=${PROJECT_SOURCE_DIR} -P ${SPLASH_EMBED_SCRIPT}
    DEPENDS ${files} ${SPLASH_EMBED_SCRIPT}
    DEPFILE ${output}.d
    COMMENT "Embedding kernels of ${out_name}"
    VERBATIM)  # or the shell takes the separators of FILES for pipes
  target_sources(${target} PRIVATE ${output})
endfunction()
