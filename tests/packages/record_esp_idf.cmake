# Runs the component's CMakeLists.txt with stand-ins for ESP-IDF's functions that write down what
# they are told.
#     cmake -DCOMPONENT=folder -DOUT=file [-DPEL_CLASS_MAX=n] -P record_esp_idf.cmake
file(WRITE ${OUT} "")

function(idf_component_register)
    cmake_parse_arguments(ARG "" "" "SRCS;INCLUDE_DIRS;PRIV_INCLUDE_DIRS;REQUIRES" ${ARGN})
    if(ARG_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "unknown: ${ARG_UNPARSED_ARGUMENTS}")
    endif()
    file(APPEND ${OUT} "sources;${ARG_SRCS}\ninclude;${ARG_INCLUDE_DIRS}\n"
        "private;${ARG_PRIV_INCLUDE_DIRS}\n")
    set(COMPONENT_LIB __idf_pel PARENT_SCOPE)
endfunction()

function(target_compile_definitions target scope)
    if(NOT target STREQUAL "__idf_pel" OR NOT scope STREQUAL "PUBLIC")
        message(FATAL_ERROR "definitions of ${target}, ${scope}")
    endif()
    file(APPEND ${OUT} "definitions;${ARGN}\n")
endfunction()

include(${COMPONENT}/CMakeLists.txt)
