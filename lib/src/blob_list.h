/* The order of blobs and the heap that keeps the largest. Private to blobs.c and blob_list.c. */
#ifndef PEL_BLOB_LIST_H
#define PEL_BLOB_LIST_H

#include "pel/blobs.h"

/* Whether a comes before b in a sorted list, see pel_blobs_sort. */
int pel_i_blob_before(const pel_blob *a, const pel_blob *b);

/* Turns a list into a heap: the blob that comes last in the order is the first element. */
void pel_i_heap_make(pel_blob *heap, uint32_t count);

/* Puts a blob in the place of the first element of a heap. */
void pel_i_heap_replace(pel_blob *heap, uint32_t count, const pel_blob *blob);

#endif
