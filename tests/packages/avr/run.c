/*
 * Runs a program for the ATmega2560 at 16 MHz in simavr: its UART 0 comes out on standard output,
 * and the last line says
 *
 *     RAM: data D + bss B + stack S = T of R bytes
 *
 * with the deepest stack that the run reached: memory above the variables is painted before it.
 *
 *     avr_run PROGRAM.elf CYCLES_MAX [STOP_TEXT]
 *
 * The run ends well when the program sleeps with interrupts off, or printed a line with STOP_TEXT.
 */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>

enum { PAINT = 0xA5 };

static const char mcu[] = "atmega2560";
static const uint32_t frequency_hz = 16000000;

typedef struct watcher {
    const char *stop_text;
    char line[256];
    size_t length;
    int stopped;
} watcher;

static void on_byte(struct avr_irq_t *irq, uint32_t value, void *param)
{
    watcher *const w = param;

    (void)irq;
    putchar((int)(value & 0xFF));
    if (value != '\n' && w->length + 1 < sizeof w->line) {
        w->line[w->length++] = (char)value;
        return;
    }
    w->line[w->length] = '\0';
    w->length = 0;
    if (w->stop_text && strstr(w->line, w->stop_text)) {
        w->stopped = 1;
    }
}

/* simavr tells on standard output what it loads: not ours to print. */
static void say_errors(struct avr_t *avr, const int level, const char *format, va_list arguments)
{
    (void)avr;
    if (level <= LOG_ERROR) {
        vfprintf(stderr, format, arguments);
    }
}

/* The bytes are ours to print, and the program may wait for its UART without being slept. */
static void listen(avr_t *avr, watcher *w)
{
    uint32_t flags = 0;
    avr_irq_t *const output = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT);

    avr_ioctl(avr, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
    flags &= ~((uint32_t)AVR_UART_FLAG_STDIO | (uint32_t)AVR_UART_FLAG_POLL_SLEEP);
    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
    avr_irq_register_notify(output, on_byte, w);
}

/* Where the variables begin: behind the registers and the I/O. */
static unsigned ram_start(const avr_t *avr)
{
    return avr->ioend + 1u;
}

static unsigned ram_end(const avr_t *avr)
{
    return avr->ramend + 1u;
}

static void paint(avr_t *avr)
{
    memset(avr->data + ram_start(avr), PAINT, ram_end(avr) - ram_start(avr));
}

static int report(const avr_t *avr, const elf_firmware_t *firmware)
{
    const unsigned data = firmware->datasize, bss = firmware->bsssize;
    const unsigned start = ram_start(avr), end = ram_end(avr);
    unsigned lowest = start + data + bss;

    while (lowest < end && avr->data[lowest] == PAINT) {
        lowest++;
    }
    printf("\nRAM: data %u + bss %u + stack %u = %u of %u bytes\n", data, bss, end - lowest,
           data + bss + end - lowest, end - start);
    if (lowest == start + data + bss) {
        fprintf(stderr, "avr_run: the stack reached the variables\n");
        return 1;
    }
    return 0;
}

int main(int argc, char **argv)
{
    static elf_firmware_t firmware;
    static watcher w;
    unsigned long long cycles_max;
    avr_t *avr;
    int state = cpu_Running;

    avr_global_logger_set(say_errors);
    if (argc < 3 || elf_read_firmware(argv[1], &firmware) != 0) {
        fprintf(stderr, "usage: avr_run PROGRAM.elf CYCLES_MAX [STOP_TEXT]\n");
        return 2;
    }
    avr = avr_make_mcu_by_name(mcu);
    if (!avr || avr_init(avr) != 0) {
        fprintf(stderr, "avr_run: simavr has no %s\n", mcu);
        return 2;
    }
    cycles_max = strtoull(argv[2], NULL, 10);
    w.stop_text = argc > 3 ? argv[3] : NULL;
    avr_load_firmware(avr, &firmware);
    avr->frequency = frequency_hz;
    avr->log = LOG_ERROR;
    paint(avr);
    listen(avr, &w);
    while (state != cpu_Done && state != cpu_Crashed && !w.stopped && avr->cycle < cycles_max) {
        state = avr_run(avr);
    }
    if (state == cpu_Crashed || (state != cpu_Done && !w.stopped)) {
        fprintf(stderr, "avr_run: %s after %llu cycles\n",
                state == cpu_Crashed ? "crashed" : "still running", (unsigned long long)avr->cycle);
        return 1;
    }
    return report(avr, &firmware);
}
