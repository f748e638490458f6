#include "scene.h"

#include <string.h>

#include "say.h"

/*
 * The class boxes hold every colour that the renderer's paints take between its darkest shade and
 * its highlight, in full range; they are checked by classifying rendered scenes against their
 * masks.
 */
static const struct {
    const char *name;
    uint8_t red, green, blue;
    pel_color_box box;
} class_table[SCENE_CLASSES] = {
    {"orange", 255, 128, 0, {50, 215, 30, 103, 160, 230}},
    {"yellow", 255, 230, 0, {90, 255, 0, 84, 130, 158}},
    {"red", 255, 0, 80, {30, 135, 106, 130, 152, 240}},
    {"blue", 60, 120, 255, {30, 160, 148, 230, 60, 119}},
    {"white", 255, 255, 255, {135, 255, 112, 138, 116, 142}},
    {"green", 0, 150, 60, {30, 130, 92, 122, 70, 113}},
};

static const char *const kind_names[] = {"ball", "cone", "post", "goal", "lines", "floor"};

const char *scene_kind_name(scene_kind kind)
{
    return kind_names[kind];
}

void scene_classes(classes *list)
{
    memset(list, 0, sizeof *list);
    list->count = SCENE_CLASSES;
    list->range = PEL_RANGE_FULL;
    for (unsigned i = 0; i < SCENE_CLASSES; i++) {
        class_entry *entry = &list->entry[i];
        strcpy(entry->name, class_table[i].name);
        entry->red = class_table[i].red;
        entry->green = class_table[i].green;
        entry->blue = class_table[i].blue;
        entry->expected = 1;
        entry->box = class_table[i].box;
        (void)pel_boxes_set(&list->boxes, i, &entry->box);
    }
    list->classifier.boxes = &list->boxes;
    list->classifier.reader = pel_crow_read_yuv;
    list->classifier.pieces = pel_classify_pieces;
    list->classifier.range = PEL_RANGE_FULL;
}

/* ---- Chance -------------------------------------------------------------------------------- */

uint32_t scene_random(uint32_t seed, uint32_t index)
{
    uint32_t h = seed + 0x9e3779b9u * (index + 1u);
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    h ^= h >> 16;
    return h;
}

struct dice {
    uint32_t seed, index;
};

/* The next number from..to, both included. */
static int64_t throw(struct dice * dice, int64_t from, int64_t to)
{
    return from + (int64_t)(scene_random(dice->seed, dice->index++) % (uint64_t)(to - from + 1));
}

/* ---- The camera ---------------------------------------------------------------------------- */

trace_ray scene_ray(const struct scene *scene, int64_t x_q8, int64_t y_q8)
{
    const scene_options *options = &scene->options;
    const int64_t u = x_q8 - ((int64_t)options->width - 1) * 128;
    const int64_t v = y_q8 - ((int64_t)options->height - 1) * 128;
    trace_ray ray;
    ray.origin.x = 0;
    ray.origin.y = 0;
    ray.origin.z = options->height_mm;
    ray.direction.x = u;
    ray.direction.y = (scene->focal_q8 * scene->pitch_cos - v * scene->pitch_sin) >> 30;
    ray.direction.z = (-scene->focal_q8 * scene->pitch_sin - v * scene->pitch_cos) >> 30;
    ray.direction = trace_unit(ray.direction);
    return ray;
}

static vec turn(const struct scene *scene, vec v)
{
    vec turned = v;
    turned.x = (v.x * scene->yaw_cos - v.y * scene->yaw_sin + (1 << 29)) >> 30;
    turned.y = (v.x * scene->yaw_sin + v.y * scene->yaw_cos + (1 << 29)) >> 30;
    return turned;
}

static vec turn_back(const struct scene *scene, vec v)
{
    vec turned = v;
    turned.x = (v.x * scene->yaw_cos + v.y * scene->yaw_sin + (1 << 29)) >> 30;
    turned.y = (v.y * scene->yaw_cos - v.x * scene->yaw_sin + (1 << 29)) >> 30;
    return turned;
}

static vec to_field(const struct scene *scene, vec point)
{
    vec placed = turn(scene, point);
    placed.x += scene->camera_in_field.x;
    placed.y += scene->camera_in_field.y;
    return placed;
}

trace_ray scene_ray_in_field(const struct scene *scene, const trace_ray *ray)
{
    trace_ray placed;
    placed.origin = to_field(scene, ray->origin);
    placed.direction = turn(scene, ray->direction);
    return placed;
}

/* Where the robot stands, and what the camera's numbers mean. */
static void set_camera(struct scene *scene, struct dice *dice)
{
    const scene_options *options = &scene->options;
    const int32_t yaw_mdeg = (int32_t) throw(dice, -22000, 22000);
    const int32_t half_mdeg = options->fov_mdeg / 2;
    scene->pitch_sin = trace_sin_q30(options->pitch_mdeg);
    scene->pitch_cos = trace_cos_q30(options->pitch_mdeg);
    scene->yaw_sin = trace_sin_q30(yaw_mdeg);
    scene->yaw_cos = trace_cos_q30(yaw_mdeg);
    scene->focal_q8 = (int64_t)options->width * 128 * (trace_cos_q30(half_mdeg) >> 8) /
                      (trace_sin_q30(half_mdeg) >> 8);
    scene->camera_in_field.x = throw(dice, -600, 600);
    scene->camera_in_field.y = throw(dice, -1500, -700);
    scene->camera_in_field.z = options->height_mm;
}

/* ---- The things ---------------------------------------------------------------------------- */

static int add_object(struct scene *scene, scene_kind kind, enum scene_class class_index)
{
    scene_object *object = &scene->object[scene->object_count];
    object->kind = kind;
    object->class_index = class_index;
    return (int)scene->object_count++;
}

static void add_solid(struct scene *scene, trace_solid solid, int object, int in_field)
{
    solid.object = object;
    solid.in_field = in_field;
    scene->solid[scene->solid_count++] = solid;
}

/* Where the ray meets the floor: 1 and the place in mm, or 0 if it does not within 3 m. */
static int floor_point(const trace_ray *ray, vec *point)
{
    const vec d = ray->direction;
    if (d.z >= 0) {
        return 0;
    }
    point->x = ray->origin.z * d.x / -d.z;
    point->y = ray->origin.z * d.y / -d.z;
    point->z = 0;
    return point->x * point->x + point->y * point->y <= 3000 * 3000;
}

/* Whether a thing of this radius can stand there: on the field, off the robot, off other things. */
static int is_free(const struct scene *scene, vec point, int64_t radius)
{
    const vec field = to_field(scene, point);
    const int64_t apart = radius + 150;
    const int64_t side = FIELD_HALF_WIDTH + 200 - radius;
    const int64_t end = FIELD_HALF_LENGTH - 100 - radius;
    if (field.x < -side || field.x > side || field.y < -end || field.y > end ||
        point.x * point.x + point.y * point.y < apart * apart) {
        return 0;
    }
    for (unsigned i = 0; i < scene->object_count; i++) {
        const scene_object *other = &scene->object[i];
        const int64_t x = point.x - other->x_mm;
        const int64_t y = point.y - other->y_mm;
        const int64_t room = radius + other->radius_mm + 60;
        if (x * x + y * y < room * room) {
            return 0;
        }
    }
    return 1;
}

/* Looks for a free place in what the camera sees, evenly over the picture. */
static int find_place(const struct scene *scene, struct dice *dice, int64_t radius, vec *point)
{
    const int64_t width_q8 = (int64_t)scene->options.width * 256;
    const int64_t height_q8 = (int64_t)scene->options.height * 256;
    for (int tries = 0; tries < 400; tries++) {
        const int64_t x_q8 = throw(dice, width_q8 / 16, width_q8 - width_q8 / 16);
        const int64_t y_q8 = throw(dice, 0, height_q8 - height_q8 / 12);
        const trace_ray ray = scene_ray(scene, x_q8, y_q8);
        if (floor_point(&ray, point) && is_free(scene, *point, radius)) {
            return 1;
        }
    }
    return 0;
}

static void stand(struct scene *scene, int object, vec point, int64_t radius, int64_t height)
{
    scene_object *placed = &scene->object[object];
    placed->x_mm = (int32_t)point.x;
    placed->y_mm = (int32_t)point.y;
    placed->radius_mm = (int32_t)radius;
    placed->height_mm = (int32_t)height;
}

static int add_ball(struct scene *scene, struct dice *dice, unsigned index)
{
    const int64_t radius = throw(dice, 50, 80);
    vec point;
    if (!find_place(scene, dice, radius, &point)) {
        return -1;
    }
    const int object = add_object(scene, SCENE_BALL, index % 3 == 1 ? SCENE_YELLOW : SCENE_ORANGE);
    stand(scene, object, point, radius, 2 * radius);
    add_solid(scene, trace_ball(point.x, point.y, radius), object, 0);
    return 0;
}

static int add_cone(struct scene *scene, struct dice *dice)
{
    const int64_t radius = throw(dice, 60, 85);
    const int64_t apex = radius * 5;
    const int64_t top = apex - radius;
    const int64_t plate = radius * 5 / 4;
    vec point;
    if (!find_place(scene, dice, plate, &point)) {
        return -1;
    }
    const int object = add_object(scene, SCENE_CONE, SCENE_RED);
    const vec half = {plate, plate, 14};
    stand(scene, object, point, plate, top);
    add_solid(scene, trace_cone(point.x, point.y, radius, apex, top), object, 0);
    add_solid(scene, trace_box(point, half), object, 0);
    return 0;
}

/* What stands on the field in every scene: its place in the list is in robot coordinates. */
static int add_fixture(struct scene *scene, scene_kind kind, enum scene_class class_index, vec foot)
{
    const int object = add_object(scene, kind, class_index);
    vec point = foot;
    point.x -= scene->camera_in_field.x;
    point.y -= scene->camera_in_field.y;
    point = turn_back(scene, point);
    scene->object[object].x_mm = (int32_t)point.x;
    scene->object[object].y_mm = (int32_t)point.y;
    return object;
}

static void add_posts(struct scene *scene)
{
    for (int i = 0; i < 4; i++) {
        const vec foot = {i % 2 ? FIELD_HALF_WIDTH : -FIELD_HALF_WIDTH,
                          i < 2 ? FIELD_HALF_LENGTH : -FIELD_HALF_LENGTH, 0};
        const enum scene_class colour = i == 0 || i == 3 ? SCENE_YELLOW : SCENE_BLUE;
        const int object = add_fixture(scene, SCENE_POST, colour, foot);
        scene->object[object].radius_mm = 60;
        scene->object[object].height_mm = 700;
        add_solid(scene, trace_post(foot.x, foot.y, 60, 700), object, 1);
    }
}

static void add_goal(struct scene *scene)
{
    const vec foot = {0, FIELD_HALF_LENGTH, 0};
    const vec left = {-FIELD_GOAL_HALF_WIDTH, FIELD_HALF_LENGTH + 150, 0};
    const vec right = {FIELD_GOAL_HALF_WIDTH, FIELD_HALF_LENGTH + 150, 0};
    const vec back = {0, FIELD_HALF_LENGTH + 300, 0};
    const vec side_half = {30, 150, 450};
    const vec back_half = {FIELD_GOAL_HALF_WIDTH + 30, 20, 450};
    const int object = add_fixture(scene, SCENE_GOAL, SCENE_BLUE, foot);
    scene->object[object].radius_mm = FIELD_GOAL_HALF_WIDTH;
    scene->object[object].height_mm = 450;
    add_solid(scene, trace_box(left, side_half), object, 1);
    add_solid(scene, trace_box(right, side_half), object, 1);
    add_solid(scene, trace_box(back, back_half), object, 1);
}

static int refuse(const char *things, unsigned placed, unsigned wanted)
{
    return say_error("scene",
                     "there is room for only %u of %u %s on the floor that the camera sees", placed,
                     wanted, things);
}

int scene_build(const scene_options *options, struct scene *scene)
{
    struct dice dice = {options->seed, 0};
    memset(scene, 0, sizeof *scene);
    scene->options = *options;
    set_camera(scene, &dice);
    for (unsigned i = 0; i < options->balls; i++) {
        if (add_ball(scene, &dice, i)) {
            return refuse("balls", i, options->balls);
        }
    }
    for (unsigned i = 0; i < options->cones; i++) {
        if (add_cone(scene, &dice)) {
            return refuse("cones", i, options->cones);
        }
    }
    add_posts(scene);
    add_goal(scene);
    add_object(scene, SCENE_LINES, SCENE_WHITE);
    add_object(scene, SCENE_FLOOR, SCENE_GREEN);
    return 0;
}
