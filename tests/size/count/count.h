/*
 * What the operators of the library are measured with, on boards down to 16 KiB of RAM: a picture
 * comes from the host row by row, is turned into what the operator reads, and only the operator's
 * own calls are counted.
 */
#ifndef COUNT_H
#define COUNT_H

#include <pel.h>

enum { WIDTH = 320, HEIGHT = 240 };

/* COUNT_SMALL: 16 KiB of RAM. There is no room for a frame then, and results keep 16 blobs. */
#if COUNT_SMALL
/* 84 blobs are open at once in the worst of the pictures. */
enum { OPEN_MAX = 88, RESULTS_MAX = 16, CORNERS_MAX = 64 };
#else
enum { OPEN_MAX = PEL_BLOBS_OPEN_SAFE(WIDTH), RESULTS_MAX = 1024, CORNERS_MAX = 100 };
#endif

/* ---- Markers, which plugin.c knows by their names ------------------------------------------- */

void pel_count_on(void);   /* what follows is counted ... */
void pel_count_off(void);  /* ... until here */
void pel_count_next(void); /* the sum is written, another is begun */

/* ---- Operators ------------------------------------------------------------------------------ */

/* What is made of a row before the operator sees it, without being counted. */
typedef enum feed {
    FEED_GRAY,      /* row.bytes: Y */
    FEED_TWO_GRAYS, /* row.bytes: Y, and WIDTH bytes behind it Y from right to left */
    FEED_RGB,       /* row.bytes: R G B */
    FEED_YCBCR,     /* row.bytes: Y U V */
    FEED_LABELS,    /* row.bytes: the labels of the picture's own classes */
    FEED_EDGES,     /* output_row: strong, weak and no edge by those labels */
    FEED_CAMERA,    /* row.crow: a row of the format job.choice (of Bayer: both rows of a pair) */
    FEED_FRAME      /* row.bytes: the whole picture, Y, once all rows are there */
} feed;

typedef struct family family;

/* A measurement: a line of the table in operators.c. */
typedef struct job {
    const char *name;
    const char *picture; /* NAME.yuyv and its classes, NAME.boxes, as tests/bench makes them */
    feed feed;
    const family *run;
    int32_t choice; /* what these mean is the family's business */
    int32_t other;
    const void *data;
} job;

/* The data of a filter's line: an operator, or a kernel, or the name of one. */
typedef struct filter_choice {
    pel_filter_op *op, *second; /* second: of two filters, one on the result of the other */
    pel_filter_op_s16 *op_s16;
    const pel_kernel *kernel;
    const char *name;
} filter_choice;

/* How an operator runs. Any of these may be missing; counted is what does not say otherwise. Those
 * that return a number say how many bytes of output_row they made; the bytes go into the checksum,
 * which is the same on all boards. */
struct family {
    void (*ready)(const job *j); /* before all others, not counted */
    void (*begin)(const job *j);
    uint32_t (*push)(uint16_t y);  /* for each row */
    uint32_t (*pull)(void);        /* after each push, until it makes nothing */
    void (*between)(const job *j); /* after the last row, not counted */
    uint32_t (*end)(const job *j);
    uint32_t (*look)(void); /* a number that must be as known, such as of blobs; not counted */
};

extern const family classify_boxes, classify_table, classify_runs, runs_of_labels, chain;
extern const family read_yuv, read_rgb, color_row;
extern const family filter_row, filter_row_s16, filter_two;
extern const family table_fill, table_row, combine_row, blend_row, histogram_row, otsu, equalize;
extern const family integral_row, adaptive_row, resize_row, sums_row, balance_row;
extern const family corner_rows, corner_refine, canny_rows, canny_link, canny_hysteresis;
extern const family scan_rows, line_fit;

/* ---- Shared by the families ----------------------------------------------------------------- */

typedef struct input_row {
    const uint8_t *bytes;
    pel_crow crow;
} input_row;

extern input_row row;
extern uint64_t work[];           /* WORK_BYTES */
extern uint64_t results[];        /* RESULTS_BYTES */
extern uint32_t output_row[];     /* WIDTH + 1 words: a row of anything */
extern uint8_t labels[WIDTH];     /* for those whose output is not labels */
extern pel_boxes picture_classes; /* of the picture at hand */
extern pel_status worst;          /* of all calls; negative: the figures are worth nothing */

#define WORK_BYTES PEL_BLOBS_BYTES(WIDTH, OPEN_MAX, PEL_MEASURE_MOMENTS | PEL_MEASURE_OUTLINE)
#define RESULTS_BYTES (RESULTS_MAX * sizeof(pel_blob))

static inline uint8_t *output_bytes(void)
{
    return (uint8_t *)output_row;
}

/* Remembers the worst of the statuses; says whether this one is done. */
static inline int done(pel_status status)
{
    if (status < worst) {
        worst = status;
    }
    return status >= 0;
}

#if !COUNT_SMALL
extern uint8_t frame[WIDTH * HEIGHT];
#endif

/* feed.c: opens the picture (0, or -1 if it is not there), makes of row y what the job wants. */
int feed_open(const job *j);
void feed_row(const job *j, uint16_t y);
void feed_close(void);

#endif
