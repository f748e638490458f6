/* For sched_setaffinity, which only Linux has. */
#ifdef __linux__
#define _GNU_SOURCE
#endif

#include "benchtime.h"

#include <math.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

int benchtime_pin(void)
{
#ifdef __linux__
    cpu_set_t one;
    const int core = sched_getcpu();
    if (core < 0 || core >= CPU_SETSIZE) {
        return -1;
    }
    CPU_ZERO(&one);
    CPU_SET((size_t)core, &one);
    return sched_setaffinity(0, sizeof one, &one) == 0 ? core : -1;
#else
    return -1;
#endif
}

double benchtime_now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    double x;
    double y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    return (x > y) - (x < y);
}

/* The value `share` of the way from the smallest to the largest. */
static double quantile(const double *sorted, unsigned count, double share)
{
    const double place = share * (count - 1);
    const unsigned below = (unsigned)floor(place);
    const unsigned above = (unsigned)ceil(place);
    return (sorted[below] + sorted[above]) / 2;
}

bench_spread benchtime_spread(double *values, unsigned count, double unit)
{
    bench_spread spread;
    qsort(values, count, sizeof *values, compare);
    spread.low = quantile(values, count, 0.25) / unit;
    spread.median = quantile(values, count, 0.5) / unit;
    spread.high = quantile(values, count, 0.75) / unit;
    return spread;
}
