/* Class files and tables: what they mean, and that what is written is read again, also by
 * CMVision. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness.h"

static int read_text(const char *text, classes *list)
{
    FILE *stream = tmpfile();

    if (!stream || fwrite(text, 1, strlen(text), stream) != strlen(text)) {
        abort();
    }
    rewind(stream);
    return classes_read_stream(stream, "text", list);
}

static int same_box(const pel_color_box *a, unsigned y0, unsigned y1, unsigned u0, unsigned u1,
                    unsigned v0, unsigned v1)
{
    return a->y_min == y0 && a->y_max == y1 && a->u_min == u0 && a->u_max == u1 && a->v_min == v0 &&
           a->v_max == v1;
}

static void check_two(const char *what, const char *text)
{
    static classes list;

    if (check(read_text(text, &list) == 0, "%s: %s", what, last_message)) {
        const class_entry *e = list.entry;
        check(list.count == 2 && list.range == PEL_RANGE_LIMITED, "%s: %u classes", what,
              list.count);
        check(strcmp(e[0].name, "orange") == 0 && strcmp(e[1].name, "blue") == 0, "%s: names",
              what);
        check(e[0].red == 255 && e[0].green == 128 && e[0].blue == 0, "%s: display colour", what);
        check(e[0].merge > 0.49 && e[0].merge < 0.51 && e[0].expected == 5, "%s: merge", what);
        check(same_box(&e[0].box, 40, 200, 90, 120, 150, 200) &&
                  same_box(&e[1].box, 0, 255, 128, 255, 0, 127),
              "%s: boxes", what);
        check(pel_classify_color(&list.classifier, 40, 90, 150) == 1 &&
                  pel_classify_color(&list.classifier, 200, 120, 200) == 1 &&
                  pel_classify_color(&list.classifier, 201, 120, 200) == 0 &&
                  pel_classify_color(&list.classifier, 201, 255, 127) == 2,
              "%s: classifier", what);
    }
    classes_free(&list);
}

static void test_spellings(void)
{
    check_two(
        "as written by CMVision",
        "#! range limited\n[Colors]\n(255,128,  0) 0.5000 5 orange\n(  0,  0,255) 0.0000 1 blue\n"
        "\n[Thresholds]\n( 40:200, 90:120,150:200)\n(  0:255,128:255,  0:127)\n");
    check_two(
        "Windows line ends",
        "#! range limited\r\n[Colors]\r\n(255,128,0) 0.5 5 orange\r\n(0,0,255) 0 1 blue\r\n\r\n"
        "[Thresholds]\r\n(40:200,90:120,150:200)\r\n(0:255,128:255,0:127)\r\n");
    check_two("comments, blanks and a last line without end",
              "A free text.\n# one\n[COLORS]\n\n  (255, 128, 0)\t.5 5 orange  the ball\n# two\n"
              "(0,0,255) 0 1 blue\n[thresholds] \n#! range limited\n( 40:200, 90:120, 150:200 ) # "
              "three\n\n"
              "( 0 : 255 , 128 : 255 , 0 : 127 )");
    check_two("another order and sections of others",
              "#! range limited\n[Camera]\ngain 3\n(1)\n[Thresholds]\n(40:200,90:120,150:200)\n"
              "(0:255,128:255,0:127)\n[Colors]\n(255,128,0) 0.5 5 orange\n(0,0,255) 0 1 "
              "blue\n[End]\nbye\n");
}

static void test_range_is_full_where_nothing_is_said(void)
{
    static classes list;

    check(read_text("[Colors]\n(1,2,3) 0 1 a\n[Thresholds]\n(1:2,3:4,5:6)\n", &list) == 0, "%s",
          last_message);
    check(list.range == PEL_RANGE_FULL && list.classifier.range == PEL_RANGE_FULL, "range");
    classes_free(&list);
}

/* As many classes as there may be, with numbers that need all their digits. */
static void make_full(classes *list)
{
    unsigned i;

    memset(list, 0, sizeof *list);
    list->count = PEL_CLASS_MAX;
    list->range = PEL_RANGE_LIMITED;
    for (i = 0; i < PEL_CLASS_MAX; i++) {
        class_entry *entry = &list->entry[i];
        const pel_color_box box = {
            (uint8_t)i, (uint8_t)(200 + i), (uint8_t)(16 * i), (uint8_t)(16 * i + 15), 0, 255};
        snprintf(entry->name, sizeof entry->name, "name_%u", i);
        entry->red = (uint8_t)(255 - i);
        entry->merge = 1.0 / (i + 1);
        entry->expected = (int)i * 1000;
        entry->box = box;
        pel_boxes_set(&list->boxes, i, &box);
    }
    list->classifier.boxes = &list->boxes;
    list->classifier.range = list->range;
}

/* CMVision's rules: headers are looked for outside of sections only; the first line that is no
 * entry ends a section and counts for nothing else. */
static void check_as_cmvision(const char *path)
{
    enum { OUTSIDE, IN_COLORS, IN_THRESHOLDS } where = OUTSIDE;
    char line[256], name[256];
    int n[6], colors = 0, thresholds = 0;
    double merge;
    FILE *file = fopen(path, "r");

    while (file && fgets(line, sizeof line, file)) {
        if (where == OUTSIDE) {
            where = strncmp(line, "[Colors]", 8) == 0        ? IN_COLORS
                    : strncmp(line, "[Thresholds]", 12) == 0 ? IN_THRESHOLDS
                                                             : OUTSIDE;
        } else if (where == IN_COLORS && sscanf(line, "(%d,%d,%d) %lf %d %255s", &n[0], &n[1],
                                                &n[2], &merge, &n[3], name) == 6) {
            colors++;
        } else if (where == IN_THRESHOLDS && sscanf(line, "(%d:%d,%d:%d,%d:%d)", &n[0], &n[1],
                                                    &n[2], &n[3], &n[4], &n[5]) == 6) {
            thresholds++;
        } else {
            where = OUTSIDE;
        }
    }
    if (file) {
        fclose(file);
    }
    check(colors == PEL_CLASS_MAX && thresholds == PEL_CLASS_MAX,
          "by CMVision's rules %s has %d colours and %d thresholds", path, colors, thresholds);
}

static void test_written_is_read(void)
{
    static classes made, got;
    unsigned i;

    make_full(&made);
    check(classes_write("written.classes", &made) == 0, "%s", last_message);
    check_as_cmvision("written.classes");
    if (check(classes_read("written.classes", &got) == 0, "%s", last_message)) {
        check(got.count == made.count && got.range == made.range, "%u classes", got.count);
        check(memcmp(&got.boxes, &made.boxes, sizeof made.boxes) == 0, "boxes");
        for (i = 0; i < made.count; i++) {
            const class_entry *a = &made.entry[i], *b = &got.entry[i];
            check(strcmp(a->name, b->name) == 0 && a->red == b->red && a->green == b->green &&
                      a->blue == b->blue && memcmp(&a->merge, &b->merge, sizeof a->merge) == 0 &&
                      a->expected == b->expected && memcmp(&a->box, &b->box, sizeof a->box) == 0,
                  "class %u is not what was written", i);
        }
    }
    classes_free(&got);
    remove("written.classes");
}

/* A full-range value in limited range: white and black, or the extremes of chroma, are `span` apart
 * there, and `zero` stays at `zero_limited`. */
static uint8_t limited(unsigned value, int zero, int zero_limited, int span)
{
    return (uint8_t)(zero_limited + span * ((int)value - zero) / 255.0 + 0.5);
}

/* The label that the limited-range classes give to the middle of a colour's cell in full range,
 * 16 y + 8, 4 u + 2, 4 v + 2. */
static uint8_t label_of_cell(const classes *list, unsigned y, unsigned u, unsigned v)
{
    return pel_classify_color(&list->classifier, limited(y / 16 * 16 + 8, 0, 16, 219),
                              limited(u / 4 * 4 + 2, 128, 128, 224),
                              limited(v / 4 * 4 + 2, 128, 128, 224));
}

static void test_tables(void)
{
    static classes made, got;
    unsigned y, u, v;
    long wrong = 0;
    size_t count = 0;
    uint8_t *bytes;

    make_full(&made);
    check(classes_write_tm("written.tm", &made) == 0, "%s", last_message);
    bytes = load("written.tm", &count);
    check(bytes && count == 19 + 65536 && memcmp(bytes, "TMAP\nYUV8\n16 64 64\n", 19) == 0,
          "a table of %zu bytes", count);
    free(bytes);
    if (check(classes_read("written.tm", &got) == 0, "%s", last_message)) {
        for (y = 0; y < 256; y++) {
            for (u = 0; u < 256; u++) {
                for (v = 0; v < 256; v += 51) {
                    wrong += pel_classify_color(&got.classifier, (uint8_t)y, (uint8_t)u,
                                                (uint8_t)v) != label_of_cell(&made, y, u, v);
                }
            }
        }
        check(wrong == 0, "%ld colours are classified otherwise", wrong);
        check(got.count == PEL_CLASS_MAX && strcmp(got.entry[1].name, "class1") == 0, "names");
    }
    message_count = 0;
    check(classes_write("table.classes", &got) == -1 && message_count == 1,
          "a table written as text");
    check(access("table.classes", F_OK) != 0, "table.classes was left behind");
    classes_free(&got);
    remove("written.tm");
}

/* The order of cells, by hand: cell (y 1, u 2, v 3) of 4 x 8 x 8 stands for Y 64..127, U 64..95, V
 * 96..127. */
static void test_order_of_cells(void)
{
    char file[16 + 256] = "TMAP\nYUV8\n4 8 8\n";
    static classes list;
    FILE *stream = tmpfile();

    file[16 + 1 * 64 + 2 * 8 + 3] = 5;
    if (!stream || fwrite(file, 1, 16 + 256, stream) != 16 + 256) {
        abort();
    }
    rewind(stream);
    if (check(classes_read_stream(stream, "cells", &list) == 0, "%s", last_message)) {
        check(list.count == 5, "%u classes", list.count);
        check(pel_classify_color(&list.classifier, 64, 64, 96) == 5 &&
                  pel_classify_color(&list.classifier, 127, 95, 127) == 5 &&
                  pel_classify_color(&list.classifier, 128, 95, 127) == 0 &&
                  pel_classify_color(&list.classifier, 127, 96, 127) == 0 &&
                  pel_classify_color(&list.classifier, 127, 95, 95) == 0,
              "the cell is elsewhere");
    }
    classes_free(&list);
}

static void test_files_that_are_not_there(void)
{
    static classes list;

    check(classes_read("no/such.classes", &list) == -1 && strstr(last_message, "no/such.classes"),
          "%s", last_message);
    make_full(&list);
    check(classes_write("no/such.classes", &list) == -1 && strstr(last_message, "no/such.classes"),
          "%s", last_message);
    check(classes_write_tm("no/such.tm", &list) == -1 && strstr(last_message, "no/such.tm"), "%s",
          last_message);
    snprintf(list.entry[0].name, sizeof list.entry[0].name, "two words");
    check(classes_write("words.classes", &list) == -1 && strstr(last_message, "one word"), "%s",
          last_message);
}

int main(void)
{
    test_spellings();
    test_range_is_full_where_nothing_is_said();
    test_written_is_read();
    test_tables();
    test_order_of_cells();
    test_files_that_are_not_there();
    return finish();
}
