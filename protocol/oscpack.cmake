# SPDX-License-Identifier: MIT
# Finds oscpack, which Debian ships without CMake or pkg-config files: target oscpack::oscpack.
include_guard(GLOBAL)
find_path(OSCPACK_INCLUDE_DIR oscpack/osc/OscReceivedElements.h)
find_library(OSCPACK_LIBRARY oscpack)
if(NOT OSCPACK_INCLUDE_DIR OR NOT OSCPACK_LIBRARY)
  message(FATAL_ERROR "oscpack not found; on Debian or Ubuntu: apt install liboscpack-dev")
endif()
add_library(oscpack::oscpack INTERFACE IMPORTED GLOBAL)
target_include_directories(oscpack::oscpack SYSTEM INTERFACE ${OSCPACK_INCLUDE_DIR})
target_link_libraries(oscpack::oscpack INTERFACE ${OSCPACK_LIBRARY})
