# SiFive E (HiFive1): RV32IMAC with 16 KiB RAM, the program in serial flash.
set(PEL_BOARD_NOTE "RV32IMC, 16 KiB RAM")
set(PEL_BOARD_CORE riscv)
set(PEL_BOARD_FLAGS -march=rv32imc -mabi=ilp32 -mcmodel=medany)
set(PEL_BOARD_QEMU qemu-system-riscv32 -M sifive_e)
set(PEL_BOARD_ROM 0x20400000 0x1000000)
set(PEL_BOARD_RAM 0x80000000 0x4000)
set(PEL_BOARD_TRAPS_UNALIGNED OFF)
