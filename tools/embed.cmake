# Writes a text file as an array of bytes for C:
#   cmake -DFROM=file -DTO=file.inc -DNAME=array -P embed.cmake
file(READ ${FROM} bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
file(WRITE ${TO} "static const unsigned char ${NAME}[] = {${bytes}};\n")
