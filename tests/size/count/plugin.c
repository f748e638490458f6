/*
 * Counts the instructions that a program in QEMU executes between two calls. A TCG plugin of API
 * version 1, as QEMU 7.2 has it; the few declarations that it needs stand here, because Debian has
 * no header for them.
 *
 *     gcc -shared -fPIC -O2 -o count.so plugin.c
 *     qemu-system-arm ... -plugin file=./count.so,out=counts.txt
 *
 * The program calls three functions that do nothing (count.h). What is executed between
 * pel_count_on and pel_count_off, the return of the one and the call of the other included, is
 * added to a sum; pel_count_next writes the sum as one line and starts another:
 *
 *     sum INSTRUCTIONS REGIONS         how many, and how often counting was switched on
 *     in FUNCTION INSTRUCTIONS         where: one line for each function with any, below its sum
 *
 * Counted are blocks, each with its length, not single instructions: a block that is entered is run
 * to its end unless an instruction in it faults, and none of these programs may fault.
 */
#include <inttypes.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXPORTED __attribute__((visibility("default")))

typedef uint64_t qemu_plugin_id_t;
typedef struct qemu_info_t qemu_info_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef void (*tb_trans_cb)(qemu_plugin_id_t id, struct qemu_plugin_tb *tb);
typedef void (*tb_exec_cb)(unsigned cpu, void *data);
typedef void (*atexit_cb)(qemu_plugin_id_t id, void *data);
enum { QEMU_PLUGIN_CB_NO_REGS = 0 };

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id, tb_trans_cb callback);
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb *tb, tb_exec_cb callback, int flags,
                                          void *data);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id, atexit_cb callback, void *data);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *tb);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *tb, size_t index);
const char *qemu_plugin_insn_symbol(const struct qemu_plugin_insn *insn);

EXPORTED int qemu_plugin_version = 1;
EXPORTED int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t *info, int argc,
                                 char **argv);

/* A function of the program, by its symbol. */
typedef struct function {
    struct function *next;
    uint64_t count;
    char name[];
} function;

/* A block of instructions that is always run as a whole. */
typedef struct block {
    function *within;
    uint64_t length;
} block;

static FILE *out;
static function *functions;
static bool counting;
static uint64_t sum;
static uint64_t regions;

static void *allocate(size_t bytes)
{
    void *const memory = calloc(1, bytes);
    if (memory == NULL) {
        fprintf(stderr, "count plugin: out of memory\n");
        exit(1);
    }
    return memory;
}

static function *function_named(const char *name)
{
    function *f = functions;
    while (f != NULL && strcmp(f->name, name) != 0) {
        f = f->next;
    }
    if (f == NULL) {
        const size_t bytes = strlen(name) + 1;
        f = allocate(sizeof *f + bytes);
        memcpy(f->name, name, bytes);
        f->next = functions;
        functions = f;
    }
    return f;
}

static void on_block(unsigned cpu, void *data)
{
    const block *const b = data;
    (void)cpu;
    if (counting) {
        sum += b->length;
        b->within->count += b->length;
    }
}

/* Its own block, the return, is counted: on_block comes after this. */
static void on_switch_on(unsigned cpu, void *data)
{
    (void)cpu;
    (void)data;
    counting = true;
    regions++;
}

static void on_switch_off(unsigned cpu, void *data)
{
    (void)cpu;
    (void)data;
    counting = false;
}

static void on_next(unsigned cpu, void *data)
{
    (void)cpu;
    (void)data;
    fprintf(out, "sum %" PRIu64 " %" PRIu64 "\n", sum, regions);
    for (function *f = functions; f != NULL; f = f->next) {
        if (f->count != 0) {
            fprintf(out, "in %s %" PRIu64 "\n", f->name, f->count);
        }
        f->count = 0;
    }
    sum = 0;
    regions = 0;
}

static tb_exec_cb marker_named(const char *name)
{
    static const struct {
        const char *name;
        tb_exec_cb callback;
    } markers[] = {{"pel_count_on", on_switch_on},
                   {"pel_count_off", on_switch_off},
                   {"pel_count_next", on_next}};
    for (size_t i = 0; i < sizeof markers / sizeof markers[0]; i++) {
        if (strcmp(name, markers[i].name) == 0) {
            return markers[i].callback;
        }
    }
    return NULL;
}

static void on_translation(qemu_plugin_id_t id, struct qemu_plugin_tb *tb)
{
    const char *name = qemu_plugin_insn_symbol(qemu_plugin_tb_get_insn(tb, 0));
    (void)id;
    if (name == NULL || name[0] == '\0') {
        name = "?";
    }
    const tb_exec_cb marker = marker_named(name);
    if (marker != NULL) {
        qemu_plugin_register_vcpu_tb_exec_cb(tb, marker, QEMU_PLUGIN_CB_NO_REGS, NULL);
    }
    /* QEMU may translate a block again; the few that it does are not worth looking up. */
    block *const b = allocate(sizeof *b);
    b->within = function_named(name);
    b->length = qemu_plugin_tb_n_insns(tb);
    qemu_plugin_register_vcpu_tb_exec_cb(tb, on_block, QEMU_PLUGIN_CB_NO_REGS, b);
}

static void on_exit(qemu_plugin_id_t id, void *data)
{
    (void)id;
    (void)data;
    /* Without this line the counts are those of a program that was ended early. */
    fprintf(out, "end\n");
    fclose(out);
}

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t *info, int argc, char **argv)
{
    (void)info;
    if (argc != 1 || strncmp(argv[0], "out=", 4) != 0) {
        fprintf(stderr, "count plugin: needs out=FILE and nothing else\n");
        return -1;
    }
    out = fopen(argv[0] + 4, "w");
    if (out == NULL) {
        fprintf(stderr, "count plugin: cannot write %s\n", argv[0] + 4);
        return -1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
    qemu_plugin_register_atexit_cb(id, on_exit, NULL);
    return 0;
}
