# Runs the module's CMakeLists.txt with stand-ins for Zephyr's functions that write down what they
# are told.
#     cmake -DCOMPONENT=folder -DOUT=file [-DCONFIG_PEL=y -DCONFIG_PEL_CLASS_MAX=n]
#         -P record_zephyr.cmake
file(WRITE ${OUT} "")

function(zephyr_library_named name)
    file(APPEND ${OUT} "name;${name}\n")
endfunction()

function(zephyr_library_sources)
    file(APPEND ${OUT} "sources;${ARGN}\n")
endfunction()

function(zephyr_library_include_directories)
    file(APPEND ${OUT} "private;${ARGN}\n")
endfunction()

function(zephyr_include_directories)
    file(APPEND ${OUT} "include;${ARGN}\n")
endfunction()

function(zephyr_compile_definitions)
    file(APPEND ${OUT} "definitions;${ARGN}\n")
endfunction()

include(${COMPONENT}/zephyr/CMakeLists.txt)
