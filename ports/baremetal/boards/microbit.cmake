# BBC micro:bit: Cortex-M0, 256 KiB flash, 16 KiB RAM.
set(PEL_BOARD_NOTE "Cortex-M0, 16 KiB RAM")
set(PEL_BOARD_CORE cortexm)
set(PEL_BOARD_FLAGS -mcpu=cortex-m0)
set(PEL_BOARD_QEMU qemu-system-arm -M microbit)
set(PEL_BOARD_ROM 0x00000000 0x40000)
set(PEL_BOARD_RAM 0x20000000 0x4000)
# A real M0 faults at an unaligned word; QEMU's reads it.
set(PEL_BOARD_TRAPS_UNALIGNED OFF)
