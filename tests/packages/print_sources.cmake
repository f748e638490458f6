# Prints the library's sources, one a line: cmake -P print_sources.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../../lib/pel_files.cmake)
list(JOIN PEL_SOURCES "\n" lines)
execute_process(COMMAND ${CMAKE_COMMAND} -E echo ${lines})
