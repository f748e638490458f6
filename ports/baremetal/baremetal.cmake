# For projects configured with toolchain.cmake beside this file:
#     include(.../ports/baremetal/baremetal.cmake)
#     pel_add_image(NAME source.c ... [STACK_MIN bytes])
# and then target_link_libraries(NAME PRIVATE ...) as for any program.
set(PEL_BAREMETAL_DIR ${CMAKE_CURRENT_LIST_DIR})

option(PEL_TRAP_UNALIGNED
    "Fault at words that are not aligned, on cores that can, and compile so that none is needed" ON)

# Flags that all of a program must share, the library included.
if(PEL_TRAP_UNALIGNED AND PEL_BOARD_CORE STREQUAL cortexm)
    add_compile_options(-mno-unaligned-access)
endif()

# Objects and not an archive: the vectors are nobody's undefined symbol.
add_library(pel_baremetal OBJECT
    ${PEL_BAREMETAL_DIR}/start.c
    ${PEL_BAREMETAL_DIR}/start_${PEL_BOARD_CORE}.c
    ${PEL_BAREMETAL_DIR}/semihost.c
    ${PEL_BAREMETAL_DIR}/memory.c)
target_include_directories(pel_baremetal PUBLIC ${PEL_BAREMETAL_DIR})
# The stack's guard is not set yet when the first of these functions run.
target_compile_options(pel_baremetal PRIVATE
    -fno-stack-protector -fno-tree-loop-distribute-patterns)
if(PEL_TRAP_UNALIGNED)
    target_compile_definitions(pel_baremetal PRIVATE PEL_TRAP_UNALIGNED)
endif()
set_target_properties(pel_baremetal PROPERTIES
    C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)

function(pel_add_image name)
    cmake_parse_arguments(ARG "" "STACK_MIN" "" ${ARGN})
    if(NOT ARG_STACK_MIN)
        set(ARG_STACK_MIN 2048)
    endif()
    add_executable(${name} ${ARG_UNPARSED_ARGUMENTS} $<TARGET_OBJECTS:pel_baremetal>)
    target_include_directories(${name} PRIVATE ${PEL_BAREMETAL_DIR})
    list(GET PEL_BOARD_ROM 0 rom_base)
    list(GET PEL_BOARD_ROM 1 rom_size)
    list(GET PEL_BOARD_RAM 0 ram_base)
    list(GET PEL_BOARD_RAM 1 ram_size)
    target_link_options(${name} PRIVATE -nostartfiles -nostdlib
        LINKER:--gc-sections LINKER:-T,${PEL_BAREMETAL_DIR}/board.ld
        LINKER:--defsym=PEL_ROM_BASE=${rom_base} LINKER:--defsym=PEL_ROM_SIZE=${rom_size}
        LINKER:--defsym=PEL_RAM_BASE=${ram_base} LINKER:--defsym=PEL_RAM_SIZE=${ram_size}
        LINKER:--defsym=PEL_STACK_MIN=${ARG_STACK_MIN})
    set_target_properties(${name} PROPERTIES LINK_DEPENDS ${PEL_BAREMETAL_DIR}/board.ld)
endfunction()

# The emulator with words for the program: sh run.sh IMAGE.elf [WORD...]. PEL_QEMU_OPTIONS in the
# environment is handed to QEMU, such as those of a plugin.
list(JOIN PEL_BOARD_EMULATOR " " PEL_BOARD_EMULATOR_LINE)
configure_file(${PEL_BAREMETAL_DIR}/run.sh.in ${CMAKE_BINARY_DIR}/run.sh @ONLY)
