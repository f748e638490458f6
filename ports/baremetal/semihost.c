#include "semihost.h"

enum {
    SYS_OPEN = 0x01,
    SYS_CLOSE = 0x02,
    SYS_WRITEC = 0x03,
    SYS_WRITE0 = 0x04,
    SYS_WRITE = 0x05,
    SYS_READ = 0x06,
    SYS_SEEK = 0x0a,
    SYS_FLEN = 0x0c,
    SYS_GET_CMDLINE = 0x15,
    SYS_EXIT_EXTENDED = 0x20,
    APPLICATION_EXIT = 0x20026
};

static int32_t call(int32_t operation, const void *block)
{
#if defined(__riscv)
    register int32_t a0 __asm__("a0") = operation;
    register const void *a1 __asm__("a1") = block;
    /* The three mark the break as ours; they must be uncompressed and lie in one page. */
    __asm__ volatile(".option push\n .option norvc\n .balign 16\n"
                     "slli x0, x0, 0x1f\n ebreak\n srai x0, x0, 7\n .option pop"
                     : "+r"(a0)
                     : "r"(a1)
                     : "memory");
    return a0;
#else
    register int32_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = block;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
#endif
}

static uint32_t length_of(const char *text)
{
    uint32_t length = 0;
    while (text[length] != '\0') {
        length++;
    }
    return length;
}

void pel_host_text(const char *text)
{
    (void)call(SYS_WRITE0, text);
}

void pel_host_character(char character)
{
    (void)call(SYS_WRITEC, &character);
}

void pel_host_decimal(uint32_t value)
{
    char text[11];
    int at = 10;
    text[at] = '\0';
    do {
        at--;
        text[at] = (char)('0' + (char)(value % 10u));
        value /= 10u;
    } while (value != 0);
    pel_host_text(text + at);
}

void pel_host_hexadecimal(uint32_t value)
{
    char text[9];
    for (int i = 0; i < 8; i++) {
        text[i] = "0123456789abcdef"[(value >> (28 - 4 * i)) & 15u];
    }
    text[8] = '\0';
    pel_host_text(text);
}

int32_t pel_host_open(const char *name, enum pel_host_mode mode)
{
    const uintptr_t block[3] = {(uintptr_t)name, (uintptr_t)mode, length_of(name)};
    const int32_t handle = call(SYS_OPEN, block);
    return handle < 0 ? -1 : handle;
}

int32_t pel_host_read(int32_t handle, void *bytes, uint32_t size)
{
    const uintptr_t block[3] = {(uintptr_t)handle, (uintptr_t)bytes, size};
    /* The answer counts what was not read; more than was asked for means an error. */
    const int32_t missing = call(SYS_READ, block);
    return missing < 0 || (uint32_t)missing > size ? -1 : (int32_t)(size - (uint32_t)missing);
}

int32_t pel_host_write(int32_t handle, const void *bytes, uint32_t size)
{
    const uintptr_t block[3] = {(uintptr_t)handle, (uintptr_t)bytes, size};
    const int32_t missing = call(SYS_WRITE, block);
    return missing < 0 || (uint32_t)missing > size ? -1 : (int32_t)(size - (uint32_t)missing);
}

int32_t pel_host_seek(int32_t handle, uint32_t position)
{
    const uintptr_t block[2] = {(uintptr_t)handle, position};
    return call(SYS_SEEK, block) < 0 ? -1 : 0;
}

int32_t pel_host_length(int32_t handle)
{
    const uintptr_t block[1] = {(uintptr_t)handle};
    const int32_t length = call(SYS_FLEN, block);
    return length < 0 ? -1 : length;
}

int32_t pel_host_close(int32_t handle)
{
    const uintptr_t block[1] = {(uintptr_t)handle};
    return call(SYS_CLOSE, block) < 0 ? -1 : 0;
}

int32_t pel_host_arguments(char *line, uint32_t size)
{
    uintptr_t block[2] = {(uintptr_t)line, size};
    if (size == 0 || call(SYS_GET_CMDLINE, block) != 0) {
        return -1;
    }
    return (int32_t)length_of(line);
}

void pel_host_exit(int status)
{
    const uintptr_t held = status < 0 ? 255u : status > 255 ? 255u : (uintptr_t)status;
    const uintptr_t block[2] = {APPLICATION_EXIT, held};
    for (;;) {
        (void)call(SYS_EXIT_EXTENDED, block);
    }
}
