/*
 * Class files: CMVision's text format, as it is, plus lines of ours that CMVision skips.
 *
 *     [Colors]
 *     (255,128,  0) 0.5000 5 orange          display colour, merge density (applied on demand
 *                                            only), expected number, name
 *
 *     [Thresholds]
 *     (  40: 200,  90:120, 150:200)          Y, U, V, both ends included, in the order of [Colors]
 *     #! range limited                       ours: full or limited; full where nothing is said
 *
 * Case of the headers does not matter; '#' begins a comment line; free text before the first header
 * and whole sections of other names are skipped, as CMVision does. Anything else is refused by its
 * line. To CMVision a comment or blank line ends a section, so a file for both has them only before
 * [Colors], before [Thresholds] (where one is needed) and at the end.
 */
#ifndef CLASSFILE_H
#define CLASSFILE_H

#include <stdio.h>

#include <pel.h>

enum { CLASS_NAME_MAX = 63 };

typedef struct class_entry {
    char name[CLASS_NAME_MAX + 1];
    uint8_t red, green, blue; /* display colour */
    double merge;             /* CMVision's merge density; 0 = do not merge. Read and written; only
                                 `pel blobs --merge-classes` applies it */
    int expected;             /* CMVision's expected number of blobs */
    pel_color_box box;
} class_entry;

/* What a class file says. `boxes` is filled and `classifier` points to it; for a .tm table the
 * cells are owned and `classifier` points to them. Do not copy or move. */
typedef struct classes {
    class_entry entry[PEL_CLASS_MAX];
    unsigned count;
    pel_range range;
    pel_boxes boxes;
    uint8_t *cells;
    pel_classifier classifier;
    pel_classify_plan plan;
} classes;

/* Reads a class file or a .tm table (told by its first bytes; labels 1..n become classes named
 * "class0".. with made-up display colours, no box and full range). 0, or -1 after a message that
 * names file, line and fault; then `list` is empty. */
int classes_read(const char *path, classes *list);

/* The same for a stream that is open already, which is closed; `name` is for messages. */
int classes_read_stream(FILE *stream, const char *name, classes *list);

/* From here on the classifier works with this backend. A table has none but plain C. */
void classes_choose_backend(classes *list, pel_backend backend);

/* Writes the text format. 0, or -1 after a message. */
int classes_write(const char *path, const classes *list);

/*
 * Writes a CMVision 2 table: "TMAP\nYUV8\n16 64 64\n" and 65536 labels, each cell classified at its
 * middle. A table is a full-range one, whatever the classes are: for those of limited range each
 * middle is converted first, Y' = 16 + 219 Y / 255 and C' = 128 + 224 (C - 128) / 255, rounded,
 * halves upward. 0, or -1 after a message.
 */
int classes_write_tm(const char *path, const classes *list);

void classes_free(classes *list);

#endif
