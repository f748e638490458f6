# QEMU's own RISC-V machine as an RV32IMC: all memory is RAM, the lower part holds the program.
set(PEL_BOARD_NOTE "RV32IMC")
set(PEL_BOARD_CORE riscv)
set(PEL_BOARD_FLAGS -march=rv32imc -mabi=ilp32 -mcmodel=medany)
# Without protection registers: with them, machine mode may do nothing until they are set.
set(PEL_BOARD_QEMU qemu-system-riscv32 -M virt -bios none -cpu rv32,pmp=false)
set(PEL_BOARD_ROM 0x80000000 0x400000)
set(PEL_BOARD_RAM 0x80400000 0x400000)
set(PEL_BOARD_TRAPS_UNALIGNED OFF)
