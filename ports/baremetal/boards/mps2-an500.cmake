# Arm MPS2, FPGA image AN500: Cortex-M7 with double-precision FPU.
set(PEL_BOARD_NOTE "Cortex-M7")
set(PEL_BOARD_CORE cortexm)
set(PEL_BOARD_FLAGS -mcpu=cortex-m7 -mfloat-abi=hard -mfpu=fpv5-d16)
set(PEL_BOARD_QEMU qemu-system-arm -M mps2-an500)
set(PEL_BOARD_ROM 0x00000000 0x400000)
set(PEL_BOARD_RAM 0x20000000 0x400000)
set(PEL_BOARD_TRAPS_UNALIGNED ON)
