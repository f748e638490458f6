# Arm MPS2, FPGA image AN386: Cortex-M4 with FPU and DSP instructions.
set(PEL_BOARD_NOTE "Cortex-M4F")
set(PEL_BOARD_CORE cortexm)
set(PEL_BOARD_FLAGS -mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16)
set(PEL_BOARD_QEMU qemu-system-arm -M mps2-an386)
set(PEL_BOARD_ROM 0x00000000 0x400000)
set(PEL_BOARD_RAM 0x20000000 0x400000)
set(PEL_BOARD_TRAPS_UNALIGNED ON)
