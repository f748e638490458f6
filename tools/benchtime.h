/*
 * Times: a pinned process, a clock, and what many times of one thing say.
 *
 * The clock is that of the processor time of this process, all of its threads together. On a
 * machine that has nothing else to do it goes like any other; on a busy one it stands still while
 * others run, which otherwise would make long jobs look slower than short ones, as those are seldom
 * interrupted.
 */
#ifndef BENCHTIME_H
#define BENCHTIME_H

/* Keeps this process and those that it starts on the processor core that it is on now. The number
 * of the core, or -1 where the system does not do that. */
int benchtime_pin(void);

/* Nanoseconds of processor time since some moment. */
double benchtime_now_ns(void);

/* A median and the quartiles beside it. */
typedef struct bench_spread {
    double low, median, high;
} bench_spread;

/* Of `count` values, 1 or more, which are sorted; each quartile is the mean of the two values
 * around its place. Everything is divided by `unit`. */
bench_spread benchtime_spread(double *values, unsigned count, double unit);

#endif
