# CMake toolchain file of all boards:
#     cmake -DCMAKE_TOOLCHAIN_FILE=.../ports/baremetal/toolchain.cmake -DPEL_BOARD=microbit ...
# The board's file says which compiler and which emulator; ctest runs the programs in the emulator.
set(PEL_BOARD "" CACHE STRING "The name of a file in ports/baremetal/boards, without .cmake")
# The checks of the compiler are projects of their own and must be told the board, too.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PEL_BOARD)

set(PEL_BOARD_FILE ${CMAKE_CURRENT_LIST_DIR}/boards/${PEL_BOARD}.cmake)
if(NOT PEL_BOARD OR NOT EXISTS ${PEL_BOARD_FILE})
    file(GLOB boards RELATIVE ${CMAKE_CURRENT_LIST_DIR}/boards ${CMAKE_CURRENT_LIST_DIR}/boards/*.cmake)
    string(REPLACE ".cmake" "" boards "${boards}")
    message(FATAL_ERROR "Choose a board with -DPEL_BOARD=NAME; there are: ${boards}")
endif()
include(${PEL_BOARD_FILE})

set(CMAKE_SYSTEM_NAME Generic)
if(PEL_BOARD_CORE STREQUAL cortexm)
    set(CMAKE_SYSTEM_PROCESSOR arm)
    set(prefix arm-none-eabi-)
    list(PREPEND PEL_BOARD_FLAGS -mthumb)
elseif(PEL_BOARD_CORE STREQUAL riscv)
    set(CMAKE_SYSTEM_PROCESSOR riscv32)
    set(prefix riscv64-unknown-elf-)
else()
    message(FATAL_ERROR "${PEL_BOARD_FILE}: PEL_BOARD_CORE is cortexm or riscv")
endif()
set(CMAKE_C_COMPILER ${prefix}gcc)
# There is no C library: a program cannot be linked before there is the start-up code.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_EXECUTABLE_SUFFIX_C .elf)

list(JOIN PEL_BOARD_FLAGS " " flags)
set(CMAKE_C_FLAGS_INIT "${flags} -ffreestanding -ffunction-sections -fdata-sections")
# The compiler's own helpers; CMake puts them behind all libraries.
set(CMAKE_C_STANDARD_LIBRARIES_INIT -lgcc)

# A program that hangs, or a core that locks up, is ended after a minute with status 124.
set(PEL_BOARD_TIMEOUT 60 CACHE STRING "Seconds after which the emulator is stopped")
set(PEL_BOARD_SEMIHOSTING enable=on,target=native)
set(PEL_BOARD_EMULATOR timeout ${PEL_BOARD_TIMEOUT} ${PEL_BOARD_QEMU}
    -display none -monitor none -serial none)
set(CMAKE_CROSSCOMPILING_EMULATOR ${PEL_BOARD_EMULATOR}
    -semihosting-config ${PEL_BOARD_SEMIHOSTING} -kernel)

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
