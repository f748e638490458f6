/*
 * From packed pixels to runs in Thumb code, pair by pair as row_runs_c.c does it. In assembly,
 * because every instruction here is one per pair, and compilers move masks and pointers about
 * between the states. Elsewhere this file is empty.
 */
#include "row/row_thumb.h"

#if PEL_ROW_THUMB

/*
 * Outside of runs there are three ways to tell background, each with its loop, and the last one
 * that was right is tried first: half of the chroma, all of it, or luma. Inside, pairs are compared
 * with the mask of the pixel before.
 *
 *     r0   the pair                             r8   the first pair
 *     r1   masks of Y                           r9   place of the next edge
 *     r2   masks of the first chroma byte       r10  labels
 *     r3   masks of the second one              r11  mask of the run, see PAIR
 *     r4   mask of the left pixel               r12  from here on, fewer than eight pairs are left
 *     r5   mask of the right pixel              lr   from here on, fewer than four
 *     r6   mask of the chroma, or a place       [sp] first edge, behind the last pair
 *     r7   scratch; so are r4 to r6 until they are what they are
 *
 * The macros take the parts of a pair by their offsets: y, z the left and the right Y, c, d the
 * first and the second chroma byte.
 */

/* clang-format off */

/* ---- What Armv6-M says in more instructions ------------------------------------------------ */

#if defined(__thumb2__) && !defined(PEL_ROW_THUMB_V6)
#define SAVE "push {r4-r11, lr};"
#define RETURN "pop {r4-r11, pc};"
#define IF_NOT_0(reg, to) "cbnz " reg ", " to ";"
#define IF_0(reg, to) "cbz " reg ", " to ";"
#define IF_NOT_0_FAR(to) "bne " to ";"
/* Bytes of HALF and IF_NOT_0 together, for each of four pixel bytes: 6 / 4. */
#define HALVES_AHEAD "lsrs r4, r6, #1; adds r6, r4;"
#define PLACE(reg) "sub " reg ", r0, r8; lsrs " reg ", " reg ", #1;"
#define PUT_EDGE(place, scratch) "strh " place ", [r9], #2;"
#define PUT_LABEL(label, place, scratch) "strb " label ", [r10, " place "];"
#define INDEX(reg, mask) "rbit " reg ", " mask "; clz " reg ", " reg ";"
#define LABEL(reg, mask) INDEX(reg, mask) "adds " reg ", #1;"
#define SET_RUN(mask) "orr r11, " mask ", " mask ", lsl #8;"
#define BOTH_ARE(to) "cmp r4, r5; beq " to ";"
#define ON_BY_LUMA "cmp r0, lr; blo 31b; b 20b;"
#else
#define SAVE "push {r4-r7, lr}; mov r4, r8; mov r5, r9; mov r6, r10; mov r7, r11; push {r4-r7};"
#define RETURN "pop {r4-r7}; mov r8, r4; mov r9, r5; mov r10, r6; mov r11, r7; pop {r4-r7, pc};"
#define IF_NOT_0(reg, to) "cmp " reg ", #0; bne " to ";"
#define IF_0(reg, to) "cmp " reg ", #0; beq " to ";"
#define IF_NOT_0_FAR(to) "beq 3f; b " to "; 3:"
#define HALVES_AHEAD "adds r6, r6;"
#define PLACE(reg) "mov " reg ", r8; subs " reg ", r0, " reg "; lsrs " reg ", " reg ", #1;"
#define PUT_EDGE(place, scratch) \
    "mov " scratch ", r9; strh " place ", [" scratch "]; adds " scratch ", #2; mov r9, " scratch ";"
#define PUT_LABEL(label, place, scratch) \
    "mov " scratch ", r10; strb " label ", [" scratch ", " place "];"
/* The mask is lost. */
#define LABEL(reg, mask) "movs " reg ", #0; 1: adds " reg ", #1; lsrs " mask ", #1; bcc 1b;"
#define SET_RUN(mask) "mov r11, " mask ";"
#define BOTH_ARE(to) "cmp r5, r11; beq " to ";"
#define ON_BY_LUMA "b 30b;"
#endif

/* ---- Masks of bytes ------------------------------------------------------------------------ */

#define MASK(reg, table, at) "ldrb " reg ", [r0, #" at "]; ldrb " reg ", [" table ", " reg "];"
#define MASKS(reg, table, at, reg2, table2, at2) \
    "ldrb " reg ", [r0, #" at "]; ldrb " reg2 ", [r0, #" at2 "];" \
    "ldrb " reg ", [" table ", " reg "]; ldrb " reg2 ", [" table2 ", " reg2 "];"
#define HALF(at) MASK("r4", "r3", at)
#define OTHER_HALF(at) MASK("r6", "r2", at) "ands r6, r4;"
#define CHROMA(c, d) MASKS("r6", "r2", c, "r7", "r3", d) "ands r6, r7;"
#define LUMA(y, z) MASKS("r4", "r1", y, "r5", "r1", z)

/* ---- States -------------------------------------------------------------------------------- */

#define ENTER \
    ".syntax unified;" SAVE "mov r10, r2; mov r9, r3; mov r6, r3; lsls r7, r1, #1;" \
    "ldm r0, {r0, r1, r2, r3}; mov r8, r0; adds r7, r0; push {r6, r7};" \
    "subs r7, #12; mov lr, r7; subs r7, #16; mov r12, r7;"

/* The loops over eight pairs are entered in the middle for the last pairs of a row, so that these
 * are the last of eight: r6 becomes four times how many are left out, of which there is one at
 * least. A jump goes from four bytes behind itself. */
#define LAST_PAIRS(end) \
    "ldr r7, [sp, #4]; cmp r0, r7; bhs " end "; subs r7, #32; subs r6, r0, r7; mov r0, r7;"
#define JUMP_AHEAD "add pc, r6; nop;"

/* 10: outside, by half of the chroma. Where it does not tell for four neighbours, on to 20. */
#define OUTSIDE_BY_HALF(c, d) \
    "10: cmp r0, r12; blo 11f;" LAST_PAIRS("98f") HALVES_AHEAD JUMP_AHEAD \
    "11:" HALF(d "+0") IF_NOT_0("r4", "101f") \
    "12:" HALF(d "+4") IF_NOT_0("r4", "102f") \
    "13:" HALF(d "+8") IF_NOT_0("r4", "103f") \
    "14:" HALF(d "+12") IF_NOT_0("r4", "104f") \
    "15:" HALF(d "+16") IF_NOT_0("r4", "105f") \
    "16:" HALF(d "+20") IF_NOT_0("r4", "106f") \
    "17:" HALF(d "+24") IF_NOT_0("r4", "107f") \
    "18:" HALF(d "+28") IF_NOT_0("r4", "108f") \
    "19: adds r0, #32; cmp r0, r12; blo 11b; b 10b;" \
    "98: b 99f;" \
    "101:" OTHER_HALF(c "+0") "beq 109f; b 25f;" \
    "102:" OTHER_HALF(c "+4") "beq 13b; adds r0, #4; b 25f;" \
    "103:" OTHER_HALF(c "+8") "beq 14b; adds r0, #8; b 25f;" \
    "104:" OTHER_HALF(c "+12") "beq 15b; adds r0, #12; b 25f;" \
    "105:" OTHER_HALF(c "+16") "beq 16b; adds r0, #16; b 25f;" \
    "106:" OTHER_HALF(c "+20") "beq 17b; adds r0, #20; b 25f;" \
    "107:" OTHER_HALF(c "+24") "beq 18b; adds r0, #24; b 25f;" \
    "108:" OTHER_HALF(c "+28") "beq 19b; adds r0, #28; b 25f;" \
    "109:" HALF(d "+4") "cmp r4, #0; beq 13b;" OTHER_HALF(c "+4") "bne 26f;" \
    HALF(d "+8") "cmp r4, #0; beq 14b;" OTHER_HALF(c "+8") "bne 27f;" \
    HALF(d "+12") "cmp r4, #0; beq 15b;" OTHER_HALF(c "+12") "bne 28f;" \
    "adds r0, #16;"

/* 20: outside, by all of the chroma. Where half of it tells for the last of eight pairs, back to
 * 10. 25: the chroma is that of a class. */
#define OUTSIDE_BY_CHROMA(y, z, c, d) \
    "20: cmp r0, r12; blo 22f;" \
    "21:" LAST_PAIRS("98b") "lsls r4, r6, #1; adds r6, r4;" JUMP_AHEAD \
    "22:" CHROMA(c "+0", d "+0") "bne 25f;" \
    CHROMA(c "+4", d "+4") "bne 26f;" \
    CHROMA(c "+8", d "+8") "bne 27f;" \
    CHROMA(c "+12", d "+12") "bne 28f;" \
    CHROMA(c "+16", d "+16") "bne 29f;" \
    CHROMA(c "+20", d "+20") "bne 23f;" \
    CHROMA(c "+24", d "+24") "bne 24f;" \
    HALF(d "+28") IF_0("r4", "5f") OTHER_HALF(c "+28") "bne 2f;" \
    "adds r0, #32; cmp r0, r12; blo 22b; b 21b;" \
    "5: b 19b;" \
    "2: adds r0, #28; b 25f;" \
    "24: adds r0, #24; b 25f;" \
    "23: adds r0, #20; b 25f;" \
    "29: adds r0, #16; b 25f;" \
    "28: adds r0, #12; b 25f;" \
    "27: adds r0, #8; b 25f;" \
    "26: adds r0, #4;" \
    "25:" LUMA(y "+0", z "+0") "ands r5, r6; ands r4, r6; bne 40f; cmp r5, #0; bne 42f;" \
    "adds r0, #4;"

/* 30: outside, by luma. */
#define OUTSIDE_BY_LUMA(y, z, c, d) \
    "30: cmp r0, lr; bhs 32f;" \
    "31:" LUMA(y "+0", z "+0") "adds r6, r4, r5; bne 35f;" \
    LUMA(y "+4", z "+4") "adds r6, r4, r5; bne 36f;" \
    LUMA(y "+8", z "+8") "adds r6, r4, r5; bne 37f;" \
    LUMA(y "+12", z "+12") "adds r6, r4, r5; bne 38f;" \
    "adds r0, #16; cmp r0, lr; blo 31b; 32: b 20b;" \
    "38: adds r0, #4;" \
    "37: adds r0, #4;" \
    "36: adds r0, #4;" \
    "35:" CHROMA(c "+0", d "+0") "beq 39f; ands r5, r6; ands r4, r6; bne 40f;" \
    IF_NOT_0("r5", "42f") "adds r0, #4; b 30b;" \
    "39: adds r0, #4; b 10b;"

/* 40: a run begins on the left. 41: at r6 in a run the right pixel differs from the left one. If
 * the run ends, luma is what ended it, as the left one has the same chroma. 42, 43: a run begins on
 * the right, and go on with 60. */
#define BEGIN \
    "40:" PLACE("r6") SET_RUN("r4") PUT_EDGE("r6", "r7") \
    LABEL("r7", "r4") PUT_LABEL("r7", "r6", "r4") BOTH_ARE("60f") \
    "41: adds r6, #1;" IF_NOT_0("r5", "44f") PUT_EDGE("r6", "r7") "adds r0, #4;" ON_BY_LUMA \
    "44:" RIGHT_DIFFERS "b 60f;" \
    "42:" PLACE("r6") "adds r6, #1;" \
    "43:" SET_RUN("r5") PUT_EDGE("r6", "r7") \
    LABEL("r7", "r5") PUT_LABEL("r7", "r6", "r4")

/* The masks of a run change, on the left or at r6 on the right: if the label does, the run ends and
 * another begins. 60: inside, a pair after the other. */
#if defined(__thumb2__) && !defined(PEL_ROW_THUMB_V6)
/* Both pixels in one comparison: r11 has the mask twice, in its low bytes. */
#define PAIR(y, z, c, d, to) \
    LUMA(y, z) CHROMA(c, d) "ands r4, r6; ands r5, r6; orr r7, r4, r5, lsl #8;" \
    "cmp r7, r11; bne " to ";"
#define MEET(mask, before, after, place) \
    INDEX(before, "r11") SET_RUN(mask) INDEX(after, mask) "cmp " before ", " after "; beq 2f;" \
    place "adds " after ", #1;" PUT_EDGE("r6", "") PUT_EDGE("r6", "") PUT_LABEL(after, "r6", "") \
    "2:"
#define RIGHT_DIFFERS MEET("r5", "r7", "r4", "")
#define LEFT_DIFFERS MEET("r4", "r6", "r7", PLACE("r6")) "cmp r4, r5;"
#define IS_RUN(mask, scratch) "orr " scratch ", " mask ", " mask ", lsl #8; cmp " scratch ", r11;"
#else
#define PAIR(y, z, c, d, to) \
    LUMA(y, z) CHROMA(c, d) "ands r4, r6; ands r5, r6;" \
    "cmp r4, r11; bne " to "; cmp r5, r11; bne " to ";"
#define MEET(mask) \
    "mov r7, r9; subs r7, #2; ldrh r7, [r7]; add r7, r10; ldrb r7, [r7]; push {r7};" \
    LABEL("r4", mask) "pop {r7}; cmp r4, r7; beq 2f;" \
    PUT_EDGE("r6", "r7") PUT_EDGE("r6", "r7") PUT_LABEL("r4", "r6", "r7") "2:"
#define RIGHT_DIFFERS "mov r11, r5;" MEET("r5")
#define LEFT_DIFFERS \
    PLACE("r6") "mov r11, r4; push {r5}; movs r5, r4;" MEET("r5") "pop {r5}; cmp r5, r11;"
#define IS_RUN(mask, scratch) "cmp " mask ", r11;"
#endif
#define INSIDE(y, z, c, d) \
    "60: adds r0, #4; cmp r0, lr; bhs 70f;" \
    "61:" PAIR(y "+0", z "+0", c "+0", d "+0", "80f") \
    PAIR(y "+4", z "+4", c "+4", d "+4", "81f") \
    PAIR(y "+8", z "+8", c "+8", d "+8", "82f") \
    PAIR(y "+12", z "+12", c "+12", d "+12", "83f") \
    "adds r0, #16; cmp r0, lr; blo 61b;"

/* 70: inside, one by one to the end. 80: a pair differs from the run. If its chroma is that of no
 * class, whether half of it tells decides how to go on. */
#define INSIDE_AT_THE_END(y, z, c, d) \
    "70: ldr r7, [sp, #4]; cmp r0, r7; bhs 90f;" \
    PAIR(y "+0", z "+0", c "+0", d "+0", "80f") "adds r0, #4; b 70b;"
#define CHANGE(d) \
    "83: adds r0, #12; b 80f;" \
    "82: adds r0, #8; b 80f;" \
    "81: adds r0, #4;" \
    "80:" IF_NOT_0("r4", "89f") IF_NOT_0("r6", "87f") \
    PLACE("r6") PUT_EDGE("r6", "r4") MASK("r7", "r3", d "+0") "adds r0, #4; cmp r7, #0;" \
    IF_NOT_0_FAR("20b") "b 10b;" \
    "87:" PLACE("r7") PUT_EDGE("r7", "r4") IF_NOT_0("r5", "88f") "adds r0, #4;" ON_BY_LUMA \
    "88: adds r6, r7, #1; b 43b;" \
    "89:" IS_RUN("r4", "r7") "beq 84f;" LEFT_DIFFERS "bne 84f; b 60b;" \
    "84:" PLACE("r6") "b 41b;"

/* A run that is open ends behind the last pair. */
#define LEAVE \
    "90:" PLACE("r6") PUT_EDGE("r6", "r7") \
    "99: pop {r1, r2}; mov r0, r9; subs r0, r1; lsrs r0, #2;" RETURN

/* In parts, as strings have a limit. */
#define RUNS(y, c, z, d) \
    __asm__(ENTER OUTSIDE_BY_HALF(c, d) OUTSIDE_BY_CHROMA(y, z, c, d)); \
    __asm__(".syntax unified;" OUTSIDE_BY_LUMA(y, z, c, d) BEGIN); \
    __asm__(".syntax unified;" INSIDE(y, z, c, d) INSIDE_AT_THE_END(y, z, c, d) CHANGE(d) LEAVE)

/* clang-format on */

#define NAKED __attribute__((naked, noinline))
#define UNUSED __attribute__((unused))

NAKED uint16_t pel_row_runs_y_first_thumb(UNUSED const pel_row_packed *row, UNUSED uint16_t count,
                                          UNUSED uint8_t *labels, UNUSED uint16_t *edges)
{
    RUNS("0", "1", "2", "3");
}

NAKED uint16_t pel_row_runs_y_second_thumb(UNUSED const pel_row_packed *row, UNUSED uint16_t count,
                                           UNUSED uint8_t *labels, UNUSED uint16_t *edges)
{
    RUNS("1", "0", "3", "2");
}

#else
typedef int nothing_here; /* an empty file is no C */
#endif
