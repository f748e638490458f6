#include "trace.h"

#include <pel.h>

int64_t trace_dot(vec a, vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vec subtract(vec a, vec b)
{
    const vec difference = {a.x - b.x, a.y - b.y, a.z - b.z};
    return difference;
}

vec trace_unit(vec v)
{
    const int64_t length = (int64_t)pel_isqrt64((uint64_t)trace_dot(v, v));
    vec unit = v;
    if (length > 0) {
        unit.x = v.x * 65536 / length;
        unit.y = v.y * 65536 / length;
        unit.z = v.z * 65536 / length;
    }
    return unit;
}

/* ---- Angles -------------------------------------------------------------------------------- */

static int64_t multiply_q30(int64_t a, int64_t b)
{
    return (a * b + ((int64_t)1 << 29)) >> 30;
}

/* Taylor's series for 0..90 degrees; its first omitted term is below 2^-33 there. */
static int64_t sine_of_quarter_q30(int64_t angle_mdeg)
{
    static const int64_t divisor[] = {15 * 14, 13 * 12, 11 * 10, 9 * 8, 7 * 6, 5 * 4, 3 * 2};
    const int64_t one = (int64_t)1 << 30;
    const int64_t x = (angle_mdeg * 18740330077 + 500000) / 1000000; /* pi / 180000 * 2^30 */
    const int64_t square = multiply_q30(x, x);
    int64_t sum = one;
    for (unsigned i = 0; i < sizeof divisor / sizeof divisor[0]; i++) {
        sum = one - multiply_q30(square, sum) / divisor[i];
    }
    return multiply_q30(x, sum);
}

int64_t trace_sin_q30(int32_t angle_mdeg)
{
    const int64_t angle = angle_mdeg < 0 ? -(int64_t)angle_mdeg : angle_mdeg;
    const int64_t sine = sine_of_quarter_q30(angle > 90000 ? 180000 - angle : angle);
    return angle_mdeg < 0 ? -sine : sine;
}

int64_t trace_cos_q30(int32_t angle_mdeg)
{
    const int32_t angle = angle_mdeg < 0 ? -angle_mdeg : angle_mdeg;
    return trace_sin_q30(90000 - angle);
}

/* ---- Solids -------------------------------------------------------------------------------- */

static void enclose(trace_solid *solid, int64_t half_width, int64_t half_height)
{
    const int64_t square = half_width * half_width + half_height * half_height;
    solid->bound = solid->centre;
    solid->bound.z += half_height;
    solid->bound_radius = (int64_t)pel_isqrt64((uint64_t)square) + 2;
}

trace_solid trace_ball(int64_t x, int64_t y, int64_t radius)
{
    trace_solid ball = {0};
    ball.kind = SOLID_BALL;
    ball.centre.x = x;
    ball.centre.y = y;
    ball.centre.z = radius;
    ball.radius = radius;
    ball.bound = ball.centre;
    ball.bound_radius = radius + 1;
    return ball;
}

trace_solid trace_cone(int64_t x, int64_t y, int64_t radius, int64_t apex, int64_t top)
{
    trace_solid cone = {0};
    cone.kind = SOLID_CONE;
    cone.centre.x = x;
    cone.centre.y = y;
    cone.radius = radius;
    cone.apex = apex;
    cone.top = top;
    enclose(&cone, radius, top / 2 + 1);
    return cone;
}

trace_solid trace_post(int64_t x, int64_t y, int64_t radius, int64_t top)
{
    trace_solid post = trace_cone(x, y, radius, top, top);
    post.kind = SOLID_POST;
    return post;
}

trace_solid trace_box(vec foot, vec half)
{
    const int64_t diagonal = half.x * half.x + half.y * half.y;
    trace_solid box = {0};
    box.kind = SOLID_BOX;
    box.centre = foot;
    box.half = half;
    enclose(&box, (int64_t)pel_isqrt64((uint64_t)diagonal) + 1, half.z / 2 + 1);
    return box;
}

/* ---- Where rays meet them ------------------------------------------------------------------ */

/* Farther away than 64 m there is nothing; -1 keeps such roots out of later products. */
static int64_t near_q8(int64_t t_q8)
{
    return t_q8 > (int64_t)1 << 24 ? -1 : t_q8;
}

/* The roots of a t^2 + 2 b t + c = 0 in q8, smaller first, a in q32, b in q16, c in mm^2; 0 if
 * there are none. A root that no ray can use is negative. */
static int solve(int64_t a, int64_t b, int64_t c, int64_t roots_q8[2])
{
    const int64_t discriminant = b * b - a * c;
    if (discriminant < 0 || a == 0) {
        return 0;
    }
    const int64_t root = (int64_t)pel_isqrt64((uint64_t)discriminant);
    const int64_t first = (-b - root) * ((int64_t)1 << 24) / a;
    const int64_t second = (-b + root) * ((int64_t)1 << 24) / a;
    roots_q8[0] = near_q8(first < second ? first : second);
    roots_q8[1] = near_q8(first < second ? second : first);
    return 1;
}

static vec point_at(const trace_ray *ray, int64_t t_q8)
{
    const vec d = ray->direction;
    vec point;
    point.x = ray->origin.x * 256 + ((t_q8 * d.x) >> 16);
    point.y = ray->origin.y * 256 + ((t_q8 * d.y) >> 16);
    point.z = ray->origin.z * 256 + ((t_q8 * d.z) >> 16);
    return point;
}

static int meets_bound(const trace_solid *solid, const trace_ray *ray)
{
    const vec to = subtract(solid->bound, ray->origin);
    const int64_t along = trace_dot(ray->direction, to);
    const int64_t beside = trace_dot(to, to) - solid->bound_radius * solid->bound_radius;
    if (beside <= 0) {
        return 1;
    }
    return along > 0 && along * along >= beside * trace_dot(ray->direction, ray->direction);
}

static int hit_ball(const trace_solid *ball, const trace_ray *ray, trace_hit *found)
{
    const vec from = subtract(ray->origin, ball->centre);
    int64_t roots_q8[2];
    if (!solve(trace_dot(ray->direction, ray->direction), trace_dot(ray->direction, from),
               trace_dot(from, from) - ball->radius * ball->radius, roots_q8)) {
        return 0;
    }
    if (roots_q8[0] <= 0) {
        return 0;
    }
    found->t_q8 = roots_q8[0];
    found->point_q8 = point_at(ray, roots_q8[0]);
    found->normal.x = (found->point_q8.x - ball->centre.x * 256) * 256 / ball->radius;
    found->normal.y = (found->point_q8.y - ball->centre.y * 256) * 256 / ball->radius;
    found->normal.z = (found->point_q8.z - ball->centre.z * 256) * 256 / ball->radius;
    return 1;
}

/* The flat top of a cone or post. */
static int hit_lid(const trace_solid *cone, const trace_ray *ray, int64_t radius, trace_hit *found)
{
    const int64_t drop = ray->origin.z - cone->centre.z - cone->top;
    if (drop <= 0 || ray->direction.z >= 0) {
        return 0;
    }
    const int64_t t_q8 = drop * ((int64_t)1 << 24) / -ray->direction.z;
    const vec point = point_at(ray, t_q8);
    const int64_t x = point.x - cone->centre.x * 256;
    const int64_t y = point.y - cone->centre.y * 256;
    if (x * x + y * y > radius * radius * 65536) {
        return 0;
    }
    found->t_q8 = t_q8;
    found->point_q8 = point;
    found->normal.x = 0;
    found->normal.y = 0;
    found->normal.z = 65536;
    return 1;
}

/* slope2_q16: square of radius / apex; 0 for a post. */
static int hit_side(const trace_solid *cone, const trace_ray *ray, int64_t slope2_q16,
                    trace_hit *found)
{
    const vec d = ray->direction;
    const vec from = subtract(ray->origin, cone->centre);
    const int64_t z = from.z - cone->apex;
    const int64_t a = d.x * d.x + d.y * d.y - ((d.z * d.z) >> 16) * slope2_q16;
    const int64_t b = from.x * d.x + from.y * d.y - ((z * d.z * slope2_q16) >> 16);
    const int64_t c = from.x * from.x + from.y * from.y -
                      (slope2_q16 ? (z * z * slope2_q16) >> 16 : cone->radius * cone->radius);
    int64_t roots_q8[2];
    if (!solve(a, b, c, roots_q8)) {
        return 0;
    }
    for (int i = 0; i < 2; i++) {
        if (roots_q8[i] <= 0) {
            continue;
        }
        const vec point = point_at(ray, roots_q8[i]);
        const int64_t height_q8 = point.z - cone->centre.z * 256;
        if (height_q8 >= 0 && height_q8 <= cone->top * 256) {
            const vec out = {point.x - cone->centre.x * 256, point.y - cone->centre.y * 256,
                             ((cone->apex * 256 - height_q8) * slope2_q16) >> 16};
            found->t_q8 = roots_q8[i];
            found->point_q8 = point;
            found->normal = trace_unit(out);
            return 1;
        }
    }
    return 0;
}

static int hit_cone(const trace_solid *cone, const trace_ray *ray, trace_hit *found)
{
    const int64_t slope2_q16 = cone->radius * cone->radius * 65536 / (cone->apex * cone->apex);
    const int64_t lid = cone->radius * (cone->apex - cone->top) / cone->apex;
    return hit_lid(cone, ray, lid, found) || hit_side(cone, ray, slope2_q16, found);
}

static int hit_post(const trace_solid *post, const trace_ray *ray, trace_hit *found)
{
    return hit_lid(post, ray, post->radius, found) || hit_side(post, ray, 0, found);
}

/* The stretch of a ray between two parallel planes; 0 if it runs beside them. */
static int between(int64_t origin, int64_t direction, int64_t low, int64_t high, int64_t t_q8[2])
{
    if (direction == 0) {
        t_q8[0] = INT64_MIN;
        t_q8[1] = INT64_MAX;
        return origin > low && origin < high;
    }
    const int64_t one = (low - origin) * ((int64_t)1 << 24) / direction;
    const int64_t two = (high - origin) * ((int64_t)1 << 24) / direction;
    t_q8[0] = one < two ? one : two;
    t_q8[1] = one < two ? two : one;
    return 1;
}

static vec axis_normal(int axis, int64_t sign)
{
    vec normal = {0, 0, 0};
    int64_t *const part[] = {&normal.x, &normal.y, &normal.z};
    *part[axis] = sign;
    return normal;
}

static int hit_box(const trace_solid *box, const trace_ray *ray, trace_hit *found)
{
    const vec c = box->centre;
    const int64_t origin[] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const int64_t direction[] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const int64_t low[] = {c.x - box->half.x, c.y - box->half.y, c.z};
    const int64_t high[] = {c.x + box->half.x, c.y + box->half.y, c.z + box->half.z};
    int64_t enter = 0;
    int64_t leave = INT64_MAX;
    int face = -1;
    for (int axis = 0; axis < 3; axis++) {
        int64_t t_q8[2];
        if (!between(origin[axis], direction[axis], low[axis], high[axis], t_q8)) {
            return 0;
        }
        if (t_q8[0] > enter) {
            enter = t_q8[0];
            face = axis;
        }
        leave = t_q8[1] < leave ? t_q8[1] : leave;
    }
    if (face < 0 || enter > leave) {
        return 0;
    }
    found->t_q8 = enter;
    found->point_q8 = point_at(ray, enter);
    found->normal = axis_normal(face, direction[face] > 0 ? -65536 : 65536);
    return 1;
}

int trace_meet(const trace_solid *solid, const trace_ray *ray, trace_hit *found)
{
    static int (*const meet[])(const trace_solid *, const trace_ray *,
                               trace_hit *) = {hit_ball, hit_cone, hit_post, hit_box};
    return meets_bound(solid, ray) && meet[solid->kind](solid, ray, found);
}

void trace_room(vec low, vec high, const trace_ray *ray, trace_hit *found)
{
    const int64_t origin[] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const int64_t direction[] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const int64_t from[] = {low.x, low.y, low.z};
    const int64_t to[] = {high.x, high.y, high.z};
    int64_t leave = INT64_MAX;
    int face = 2;
    for (int axis = 0; axis < 3; axis++) {
        int64_t t_q8[2];
        if (between(origin[axis], direction[axis], from[axis], to[axis], t_q8) && t_q8[1] < leave) {
            leave = t_q8[1];
            face = axis;
        }
    }
    found->t_q8 = leave;
    found->point_q8 = point_at(ray, leave);
    found->normal = axis_normal(face, direction[face] > 0 ? -65536 : 65536);
}
