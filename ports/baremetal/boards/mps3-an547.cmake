# Arm MPS3, FPGA image AN547: Cortex-M55 with Helium; code in ITCM, data in DTCM.
set(PEL_BOARD_NOTE "Cortex-M55 with Helium")
set(PEL_BOARD_CORE cortexm)
set(PEL_BOARD_FLAGS -mcpu=cortex-m55 -mfloat-abi=hard)
set(PEL_BOARD_QEMU qemu-system-arm -M mps3-an547)
set(PEL_BOARD_ROM 0x00000000 0x80000)
set(PEL_BOARD_RAM 0x20000000 0x80000)
set(PEL_BOARD_TRAPS_UNALIGNED ON)
set(PEL_BOARD_LIMITS_STACK ON)
