/*
 * What a call answers.
 *
 * The sign tells the story: negative = refused at the door, nothing was done and no output was
 * touched; zero = done; positive = done, but incomplete, and the object counts what is missing.
 * So `if (status < 0)` catches every misuse, and `if (status != 0)` also catches overflow.
 */
#ifndef PEL_STATUS_H
#define PEL_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum pel_status {
    PEL_OK = 0,
    PEL_TRUNCATED = 1,   /* done; something did not fit, was left out and counted */
    PEL_ERR_ARG = -1,    /* a null pointer, a misaligned buffer, or a value outside its range */
    PEL_ERR_FORMAT = -2, /* this pixel format or colour range cannot do that */
    PEL_ERR_SPACE = -3,  /* a buffer that the caller gave is too small */
    PEL_ERR_RANGE = -4,  /* a size at which a sum could overflow, or a part outside the whole */
    PEL_ERR_ORDER = -5 /* a call out of turn: a row skipped or repeated, end before the last row */
} pel_status;

/* The name of a status, such as "PEL_ERR_SPACE"; "?" for a value that is none. Static text. */
const char *pel_status_name(pel_status status);

#ifdef __cplusplus
}
#endif

#endif
