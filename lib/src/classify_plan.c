/* Box tables prepared for processors that look up many bytes at once. */
#include "pel/classify.h"

#include "row/row_nibbles.h"

#if PEL_CLASS_MAX == 8

/* The interval of values that have a bit in a table. 0 if they are none. */
static int is_interval(const uint8_t table[256], unsigned bit, unsigned *min, unsigned *max)
{
    unsigned first = 256, last = 0, count = 0;

    for (unsigned i = 0; i < 256; i++) {
        if (table[i] >> bit & 1) {
            first = first < i ? first : i;
            last = i;
            count++;
        }
    }
    *min = first;
    *max = last;
    return count == 0 || last - first + 1 == count;
}

static void set_bit(uint8_t *byte, unsigned bit, int condition)
{
    if (condition) {
        *byte = (uint8_t)(*byte | 1u << bit);
    }
}

/* min > max stands for no value at all. */
static void add_interval(uint8_t *nibbles, unsigned bit, unsigned min, unsigned max)
{
    for (unsigned i = 0; i < 16 && min <= max; i++) {
        set_bit(&nibbles[PEL_NIBBLES_ABOVE + i], bit, i > min / 16 && i <= max / 16);
        set_bit(&nibbles[PEL_NIBBLES_ROUGH + i], bit, i >= min / 16 && i <= max / 16);
        set_bit(&nibbles[PEL_NIBBLES_BELOW + i], bit, i != max / 16);
        set_bit(&nibbles[PEL_NIBBLES_FROM + i], bit, i >= min % 16);
        set_bit(&nibbles[PEL_NIBBLES_TO + i], bit, i <= max % 16);
    }
}

/* The nibble tables of a channel; 0 if a class of it is no interval. */
static int set_channel(const uint8_t table[256], uint8_t *nibbles)
{
    for (unsigned bit = 0; bit < 8; bit++) {
        unsigned min, max;
        if (!is_interval(table, bit, &min, &max)) {
            return 0;
        }
        add_interval(nibbles, bit, min, max);
    }
    return 1;
}

static int set_nibbles(pel_classify_plan *plan, const pel_boxes *boxes)
{
    uint8_t *const nibbles = plan->nibbles;

    for (unsigned i = 0; i < PEL_NIBBLES_BYTES; i++) {
        nibbles[i] = 0;
    }
    return set_channel(boxes->y, nibbles) && set_channel(boxes->u, nibbles + PEL_NIBBLES_CHANNEL) &&
           set_channel(boxes->v, nibbles + 2 * PEL_NIBBLES_CHANNEL);
}

#else
static int set_nibbles(pel_classify_plan *plan, const pel_boxes *boxes)
{
    (void)plan;
    (void)boxes;
    return 0; /* the nibble tables hold eight classes */
}
#endif

pel_status pel_classify_plan_make(pel_classify_plan *plan, const pel_boxes *boxes,
                                  pel_backend backend)
{
    if (!plan || !boxes || (unsigned)backend >= PEL_BACKEND_COUNT) {
        return PEL_ERR_ARG;
    }
    plan->backend = pel_backend_resolve(backend);
    if (plan->backend != PEL_BACKEND_SCALAR && !set_nibbles(plan, boxes)) {
        plan->backend = PEL_BACKEND_SCALAR;
    }
    return plan->backend == PEL_BACKEND_SCALAR && backend != PEL_BACKEND_SCALAR &&
                   backend != PEL_BACKEND_AUTO
               ? PEL_TRUNCATED
               : PEL_OK;
}
