/*
 * Rays and solids in integers: what the scene renderer is made of. Lengths are millimetres, unit
 * vectors and ratios have 16 fraction bits, distances along a ray 8. Everything stays exact or is
 * rounded in one defined way, so a scene has the same bytes on every machine.
 *
 * Coordinates of a ray and a solid must stay within 16 m of each other: then no product leaves
 * 63 bits.
 */
#ifndef TRACE_H
#define TRACE_H

#include <stdint.h>

typedef struct vec {
    int64_t x, y, z;
} vec;

typedef struct trace_ray {
    vec origin;    /* mm */
    vec direction; /* unit, q16 */
} trace_ray;

typedef struct trace_hit {
    int64_t t_q8; /* distance from the origin */
    vec point_q8; /* mm */
    vec normal;   /* unit, q16, pointing out of the solid */
} trace_hit;

typedef enum solid_kind { SOLID_BALL, SOLID_CONE, SOLID_POST, SOLID_BOX } solid_kind;

typedef struct trace_solid {
    solid_kind kind;
    vec centre;     /* mm, of a ball it is the middle, of all others the foot */
    int64_t radius; /* mm; of a cone, where it would meet the foot's plane */
    int64_t apex;   /* mm above the foot: where a cone would end */
    int64_t top;    /* mm above the foot: where a cone or post is cut */
    vec half;       /* mm: half width, half depth and the whole height of a box */
    vec bound;      /* centre and radius of a ball around it all */
    int64_t bound_radius;
    int object;   /* for the caller */
    int in_field; /* for the caller: placed in field coordinates */
} trace_solid;

trace_solid trace_ball(int64_t x, int64_t y, int64_t radius);
trace_solid trace_cone(int64_t x, int64_t y, int64_t radius, int64_t apex, int64_t top);
trace_solid trace_post(int64_t x, int64_t y, int64_t radius, int64_t top);
trace_solid trace_box(vec foot, vec half);

/* Where the ray enters the solid: 1 and *found, or 0 if it misses. */
int trace_meet(const trace_solid *solid, const trace_ray *ray, trace_hit *found);

/* Where a ray that starts inside the box low..high leaves it. */
void trace_room(vec low, vec high, const trace_ray *ray, trace_hit *found);

/* The vector scaled to length 1.0 in q16; coordinates up to 2^30. The zero vector stays. */
vec trace_unit(vec v);

/* The scalar product: of two q16 vectors, in q32; of a q16 vector and millimetres, in q16. */
int64_t trace_dot(vec a, vec b);

/* Sine and cosine of an angle in thousandths of a degree, -180000..180000; q30, within 4. */
int64_t trace_sin_q30(int32_t angle_mdeg);
int64_t trace_cos_q30(int32_t angle_mdeg);

#endif
