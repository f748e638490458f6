# The machine that builds, with the sanitizers: around buffers, of alignment and arithmetic.
set(CMAKE_C_COMPILER gcc)
set(CMAKE_C_FLAGS_INIT "-fsanitize=address,undefined -fno-sanitize-recover=all")
