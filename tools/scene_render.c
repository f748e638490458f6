#include "scene.h"

/* A thing's colour in full light, and how much it shines: 0..255 each. */
struct paint {
    int64_t red, green, blue, gloss;
};

static const struct paint class_paint[SCENE_CLASSES] = {
    {250, 112, 24, 62}, {231, 214, 30, 18}, {205, 25, 70, 0},
    {38, 84, 205, 0},   {236, 236, 230, 0}, {38, 128, 58, 0},
};
static const struct paint wall_paint = {120, 124, 130, 0};
static const struct paint board_paint = {44, 46, 52, 0};
static const struct paint hall_floor_paint = {86, 88, 92, 0};

/* What a ray found. */
struct sight {
    trace_hit hit;
    const trace_solid *solid; /* NULL: the hall or its floor */
    vec place_q8;             /* where, in field coordinates, mm */
    int object;               /* -1: nothing of the list */
    struct paint paint;
};

/* ---- The floor and the walls --------------------------------------------------------------- */

static int64_t absolute(int64_t value)
{
    return value < 0 ? -value : value;
}

static int near_line(int64_t value_q8, int64_t line_mm)
{
    return absolute(value_q8 - line_mm * 256) <= FIELD_LINE * 128;
}

static int on_circle(int64_t x_q8, int64_t y_q8)
{
    const int64_t square = x_q8 * x_q8 + y_q8 * y_q8;
    const int64_t inner = (FIELD_CIRCLE * 2 - FIELD_LINE) * 128;
    const int64_t outer = (FIELD_CIRCLE * 2 + FIELD_LINE) * 128;
    return square >= inner * inner && square <= outer * outer;
}

/* Both halves of the field and both sides are alike: only the distances from the middle count. */
static int is_line(vec place_q8)
{
    const int64_t half_line = FIELD_LINE * 128;
    const int64_t x = absolute(place_q8.x);
    const int64_t y = absolute(place_q8.y);
    const int64_t box = (FIELD_HALF_LENGTH - FIELD_BOX_LENGTH) * 256;
    if (x > FIELD_HALF_WIDTH * 256 + half_line || y > FIELD_HALF_LENGTH * 256 + half_line) {
        return 0;
    }
    return near_line(x, FIELD_HALF_WIDTH) || near_line(y, FIELD_HALF_LENGTH) || near_line(y, 0) ||
           (near_line(x, FIELD_BOX_HALF_WIDTH) && y > box - half_line) ||
           (near_line(y, FIELD_HALF_LENGTH - FIELD_BOX_LENGTH) &&
            x < FIELD_BOX_HALF_WIDTH * 256 + half_line) ||
           on_circle(x, y);
}

static struct paint scaled(struct paint paint, int64_t factor_q8)
{
    paint.red = paint.red * factor_q8 / 256;
    paint.green = paint.green * factor_q8 / 256;
    paint.blue = paint.blue * factor_q8 / 256;
    return paint;
}

/* Even noise 0..255 on a grid of cells, blended in between. */
static int64_t cloud(uint32_t seed, int64_t x_q8, int64_t y_q8, int64_t cell_q8)
{
    const int64_t column = (x_q8 + (1 << 24)) / cell_q8;
    const int64_t line = (y_q8 + (1 << 24)) / cell_q8;
    const int64_t fx = (x_q8 + (1 << 24)) % cell_q8;
    const int64_t fy = (y_q8 + (1 << 24)) % cell_q8;
    int64_t corner[4];
    for (int i = 0; i < 4; i++) {
        const uint32_t index = (uint32_t)((line + i / 2) * 8191 + column + i % 2);
        corner[i] = (int64_t)(scene_random(seed, index) & 255u);
    }
    const int64_t above = corner[0] * (cell_q8 - fx) + corner[1] * fx;
    const int64_t below = corner[2] * (cell_q8 - fx) + corner[3] * fx;
    return (above * (cell_q8 - fy) + below * fy) / (cell_q8 * cell_q8);
}

/* Tufts, worn patches, and the stripes that a mower or a carpet layer leaves. */
static struct paint carpet(const struct scene *scene, vec place_q8)
{
    const uint32_t seed = scene->options.seed ^ 0xca59e7u;
    const int64_t tufts = cloud(seed, place_q8.x, place_q8.y, 9 * 256) - 128;
    const int64_t patches = cloud(seed + 1, place_q8.x, place_q8.y, 170 * 256) - 128;
    const int64_t stripe = ((place_q8.y + (1 << 24)) / (375 * 256)) % 2 ? 9 : -9;
    return scaled(class_paint[SCENE_GREEN], 256 + tufts / 7 + patches / 8 + stripe);
}

static void look_at_floor(const struct scene *scene, struct sight *sight)
{
    const int64_t x = absolute(sight->place_q8.x);
    const int64_t y = absolute(sight->place_q8.y);
    const int floor = (int)scene->object_count - 1;
    if (is_line(sight->place_q8)) {
        sight->object = floor - 1;
        sight->paint = class_paint[SCENE_WHITE];
    } else if (x <= (FIELD_HALF_WIDTH + FIELD_CARPET_MARGIN) * 256 &&
               y <= (FIELD_HALF_LENGTH + FIELD_CARPET_MARGIN) * 256) {
        sight->object = floor;
        sight->paint = carpet(scene, sight->place_q8);
    } else {
        sight->paint = hall_floor_paint;
    }
}

static void look_at_wall(struct sight *sight)
{
    const int64_t height = sight->place_q8.z / 256;
    const int64_t along = sight->hit.normal.x ? sight->place_q8.y : sight->place_q8.x;
    const int64_t seam = ((along + (1 << 24)) / 256) % 700;
    if (height < 110) {
        sight->paint = board_paint;
    } else {
        sight->paint = scaled(wall_paint, 215 + height / 30 - (seam < 14 ? 26 : 0));
    }
}

/* ---- Sight --------------------------------------------------------------------------------- */

/* Turns a vector of field coordinates by the robot's heading, or back. */
static vec heading(const struct scene *scene, vec v, int64_t sine)
{
    vec turned = v;
    turned.x = (v.x * scene->yaw_cos + v.y * sine) >> 30;
    turned.y = (v.y * scene->yaw_cos - v.x * sine) >> 30;
    return turned;
}

static struct sight look(const struct scene *scene, const trace_ray *ray)
{
    const trace_ray in_field = scene_ray_in_field(scene, ray);
    const vec far_corner = {FIELD_HALF_WIDTH + FIELD_HALL_MARGIN,
                            FIELD_HALF_LENGTH + FIELD_HALL_MARGIN, FIELD_HALL_HEIGHT};
    const vec near_corner = {-far_corner.x, -far_corner.y, 0};
    struct sight nearest = {.object = -1};
    trace_room(near_corner, far_corner, &in_field, &nearest.hit);
    for (unsigned i = 0; i < scene->solid_count; i++) {
        const trace_solid *solid = &scene->solid[i];
        trace_hit hit;
        if (trace_meet(solid, solid->in_field ? &in_field : ray, &hit) &&
            hit.t_q8 < nearest.hit.t_q8) {
            nearest.hit = hit;
            nearest.solid = solid;
        }
    }
    nearest.place_q8 = nearest.hit.point_q8;
    if (nearest.solid) {
        nearest.object = nearest.solid->object;
        nearest.paint = class_paint[scene->object[nearest.object].class_index];
    } else if (nearest.hit.normal.z > 0) {
        look_at_floor(scene, &nearest);
    } else {
        look_at_wall(&nearest);
    }
    return nearest;
}

/* Whether a solid stands between the place and the light. */
static int in_shadow(const struct scene *scene, const struct sight *sight,
                     const trace_ray *to_light, const trace_ray *to_light_in_field)
{
    for (unsigned i = 0; i < scene->solid_count; i++) {
        const trace_solid *solid = &scene->solid[i];
        trace_hit hit;
        if (solid != sight->solid &&
            trace_meet(solid, solid->in_field ? to_light_in_field : to_light, &hit)) {
            return 1;
        }
    }
    return 0;
}

static vec rounded_mm(vec point_q8)
{
    const vec point = {(point_q8.x + 128) >> 8, (point_q8.y + 128) >> 8, (point_q8.z + 128) >> 8};
    return point;
}

static vec from_field(const struct scene *scene, vec point)
{
    point.x -= scene->camera_in_field.x;
    point.y -= scene->camera_in_field.y;
    return heading(scene, point, scene->yaw_sin);
}

/* The lamps hang to the left behind the robot; each ray of a pixel sees another point of them,
 * which gives shadows their soft edge. x, y: -128..128. */
static vec light_direction(int64_t x, int64_t y)
{
    vec light = {-30000 + x * 40, -24000 + y * 40, 52000};
    return trace_unit(light);
}

/* n.h to the 32nd power, h half way between light and eye (Blinn 1977): 0..65536. */
static int64_t highlight(vec normal, vec light, vec view)
{
    const vec between = {light.x - view.x, light.y - view.y, light.z - view.z};
    int64_t power = trace_dot(normal, trace_unit(between)) >> 16;
    if (power <= 0) {
        return 0;
    }
    for (int i = 0; i < 5; i++) {
        power = (power * power) >> 16;
    }
    return power;
}

/* Everything that is lit: from above by the hall, and by the lamps where they reach. */
static struct paint shade(const struct scene *scene, const struct sight *sight,
                          const trace_ray *ray, vec light)
{
    const int in_robot = sight->solid && !sight->solid->in_field;
    const vec here = in_robot ? heading(scene, light, scene->yaw_sin) : light;
    const vec view = in_robot ? ray->direction : scene_ray_in_field(scene, ray).direction;
    const int64_t facing = trace_dot(sight->hit.normal, here) >> 16;
    int64_t light_q16 = 38000 + ((sight->hit.normal.z * 5500) >> 16);
    int64_t shine = 0;
    trace_ray to_light;
    to_light.origin = rounded_mm(sight->place_q8);
    if (!in_robot) {
        to_light.origin = from_field(scene, to_light.origin);
    }
    to_light.direction = heading(scene, light, scene->yaw_sin);
    const trace_ray to_light_in_field = scene_ray_in_field(scene, &to_light);
    if (facing > 0 && !in_shadow(scene, sight, &to_light, &to_light_in_field)) {
        light_q16 += (facing * 27000) >> 16;
        shine = (sight->paint.gloss * highlight(sight->hit.normal, here, view)) >> 8;
    }
    const struct paint lit = {((sight->paint.red * light_q16) >> 8) + shine,
                              ((sight->paint.green * light_q16) >> 8) + shine,
                              ((sight->paint.blue * light_q16) >> 8) + shine, 0};
    return lit;
}

/* ---- The picture --------------------------------------------------------------------------- */

static uint16_t channel_q8(int64_t sum, int64_t count)
{
    const int64_t mean = sum / count;
    return (uint16_t)(mean > 255 * 256 ? 255 * 256 : mean);
}

static void render_pixel(const struct scene *scene, unsigned x, unsigned y, uint16_t *rgb_q8)
{
    const int64_t n = scene->options.samples;
    struct paint sum = {0, 0, 0, 0};
    for (int64_t i = 0; i < n * n; i++) {
        const int64_t dx = (2 * (i % n) + 1 - n) * 128 / n;
        const int64_t dy = (2 * (i / n) + 1 - n) * 128 / n;
        const trace_ray ray = scene_ray(scene, (int64_t)x * 256 + dx, (int64_t)y * 256 + dy);
        const struct sight sight = look(scene, &ray);
        const struct paint lit = shade(scene, &sight, &ray, light_direction(dy, -dx));
        sum.red += lit.red;
        sum.green += lit.green;
        sum.blue += lit.blue;
    }
    rgb_q8[0] = channel_q8(sum.red, n * n);
    rgb_q8[1] = channel_q8(sum.green, n * n);
    rgb_q8[2] = channel_q8(sum.blue, n * n);
}

static void count_pixel(scene_object *object, unsigned x, unsigned y)
{
    if (object->area == 0) {
        object->x0 = x;
        object->y0 = y;
    }
    object->area++;
    object->x0 = x < object->x0 ? x : object->x0;
    object->x1 = x + 1 > object->x1 ? x + 1 : object->x1;
    object->y1 = y + 1;
    object->sum_x += x;
    object->sum_y += y;
}

void scene_render(struct scene *scene, uint16_t *rgb_q8, uint8_t *labels)
{
    const scene_options *options = &scene->options;
    for (unsigned y = 0; y < options->height; y++) {
        for (unsigned x = 0; x < options->width; x++) {
            const trace_ray ray = scene_ray(scene, (int64_t)x * 256, (int64_t)y * 256);
            const int object = look(scene, &ray).object;
            const size_t index = (size_t)y * options->width + x;
            render_pixel(scene, x, y, rgb_q8 + 3 * index);
            labels[index] = 0;
            if (object >= 0) {
                labels[index] = (uint8_t)(scene->object[object].class_index + 1);
                count_pixel(&scene->object[object], x, y);
            }
        }
    }
}

/* ---- The camera's electronics -------------------------------------------------------------- */

static unsigned clamp_index(int64_t index, unsigned count)
{
    return index < 0 ? 0 : index >= (int64_t)count ? count - 1 : (unsigned)index;
}

/* The mean of 2 radius + 1 neighbours along a line of `count` samples that lie `step` apart; the
 * first and last are repeated beyond the ends. */
static void blur_line(const uint16_t *source, uint16_t *destination, unsigned count, size_t step,
                      unsigned radius)
{
    const uint32_t size = 2 * radius + 1;
    uint32_t sum = 0;
    for (unsigned i = 0; i < size; i++) {
        sum += source[clamp_index((int64_t)i - radius, count) * step];
    }
    for (unsigned i = 0; i < count; i++) {
        destination[i * step] = (uint16_t)(sum / size);
        sum += source[clamp_index((int64_t)i + radius + 1, count) * step];
        sum -= source[clamp_index((int64_t)i - radius, count) * step];
    }
}

static void blur(const scene_options *options, uint16_t *rgb_q8, uint16_t *scratch)
{
    const size_t row = 3 * (size_t)options->width;
    for (unsigned y = 0; y < options->height; y++) {
        for (unsigned c = 0; c < 3; c++) {
            blur_line(rgb_q8 + y * row + c, scratch + y * row + c, options->width, 3,
                      options->blur);
        }
    }
    for (size_t i = 0; i < row; i++) {
        blur_line(scratch + i, rgb_q8 + i, options->height, row, options->blur);
    }
}

/* Noise of standard deviation `milli` / 1000 in q8: the sum of twelve bytes, less its mean 1530,
 * has a standard deviation of 256 (its exact value: the root of 65535). */
static int64_t noise_q8(uint32_t seed, uint32_t sample, unsigned milli)
{
    int64_t sum = -1530;
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t word = scene_random(seed, 3 * sample + i);
        sum += (word & 255u) + ((word >> 8) & 255u) + ((word >> 16) & 255u) + (word >> 24);
    }
    return sum * (int64_t)milli / 1000;
}

void scene_expose(const scene_options *options, uint16_t *rgb_q8, uint16_t *scratch, uint8_t *rgb)
{
    const uint32_t count = 3 * options->width * options->height;
    const uint32_t seed = options->seed ^ 0x6e015eu;
    if (options->blur > 0) {
        blur(options, rgb_q8, scratch);
    }
    for (uint32_t i = 0; i < count; i++) {
        const int64_t gain = (int64_t)options->gain_milli * options->cast[i % 3];
        int64_t value = rgb_q8[i] * gain / 255000;
        if (options->noise_milli > 0) {
            value += noise_q8(seed, i, options->noise_milli);
        }
        value = (value + 128) >> 8;
        rgb[i] = (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
    }
}
