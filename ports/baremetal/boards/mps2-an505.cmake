# Arm MPS2, FPGA image AN505: Cortex-M33. The core starts in secure state: secure addresses.
set(PEL_BOARD_NOTE "Cortex-M33")
set(PEL_BOARD_CORE cortexm)
set(PEL_BOARD_FLAGS -mcpu=cortex-m33 -mfloat-abi=hard -mfpu=fpv5-sp-d16)
set(PEL_BOARD_QEMU qemu-system-arm -M mps2-an505)
set(PEL_BOARD_ROM 0x10000000 0x400000)
set(PEL_BOARD_RAM 0x38000000 0x400000)
set(PEL_BOARD_TRAPS_UNALIGNED ON)
set(PEL_BOARD_LIMITS_STACK ON)
