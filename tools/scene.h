/*
 * A football field in a hall, with coloured balls, cones, posts and a goal, as the camera of a
 * small robot sees it. Everything is computed in integers from a seed: the same options give the
 * same bytes on every machine, and what is where is known exactly.
 *
 * Robot coordinates: millimetres, x to the right of the camera's heading, y ahead, z up, the origin
 * on the floor below the camera.
 */
#ifndef SCENE_H
#define SCENE_H

#include "classfile.h"
#include "trace.h"

/* The field in mm, and how far its carpet and the hall go beyond its lines. */
enum {
    FIELD_HALF_WIDTH = 1500,
    FIELD_HALF_LENGTH = 2250,
    FIELD_LINE = 50,
    FIELD_CIRCLE = 500,
    FIELD_BOX_HALF_WIDTH = 800,
    FIELD_BOX_LENGTH = 500,
    FIELD_GOAL_HALF_WIDTH = 500,
    FIELD_CARPET_MARGIN = 450,
    FIELD_HALL_MARGIN = 1300,
    FIELD_HALL_HEIGHT = 3000
};

/* The classes, in the order of the class file. The label of a pixel is this + 1. */
enum scene_class {
    SCENE_ORANGE,
    SCENE_YELLOW,
    SCENE_RED,
    SCENE_BLUE,
    SCENE_WHITE,
    SCENE_GREEN,
    SCENE_CLASSES
};

enum {
    SCENE_THINGS_MAX = 50,
    SCENE_OBJECTS_MAX = 2 * SCENE_THINGS_MAX + 8,
    SCENE_SOLIDS_MAX = 200
};

/* Where a number has a unit of 1/1000 its name says milli. */
typedef struct scene_options {
    unsigned width, height; /* of the picture */
    uint32_t seed;
    int32_t height_mm;     /* of the camera over the floor, 50..2500 */
    int32_t pitch_mdeg;    /* downward, -90000..90000 */
    int32_t fov_mdeg;      /* from the left edge to the right edge, 10000..150000 */
    unsigned balls, cones; /* 0..SCENE_THINGS_MAX each */
    unsigned samples;      /* rays per pixel: samples x samples, 1..8 */
    unsigned gain_milli;
    unsigned cast[3];     /* R G B of a white sheet of paper, 0..255 */
    unsigned noise_milli; /* standard deviation */
    unsigned blur;        /* radius of the box filter in pixels */
} scene_options;

typedef enum scene_kind {
    SCENE_BALL,
    SCENE_CONE,
    SCENE_POST,
    SCENE_GOAL,
    SCENE_LINES,
    SCENE_FLOOR
} scene_kind;

/* One thing of the scene and what the picture shows of it. */
typedef struct scene_object {
    scene_kind kind;
    enum scene_class class_index;
    int32_t x_mm, y_mm; /* where it stands, in robot coordinates; 0 for the floor and its lines */
    int32_t radius_mm;
    int32_t height_mm;
    uint32_t area;           /* pixels that show it */
    unsigned x0, y0, x1, y1; /* their box, half-open; all 0 if none does */
    uint64_t sum_x, sum_y;
} scene_object;

struct scene {
    scene_options options;
    scene_object object[SCENE_OBJECTS_MAX];
    unsigned object_count;
    trace_solid solid[SCENE_SOLIDS_MAX];
    unsigned solid_count;
    int64_t pitch_sin, pitch_cos; /* q30 */
    int64_t yaw_sin, yaw_cos;     /* q30: how the robot stands on the field */
    int64_t focal_q8;             /* pixels */
    vec camera_in_field;          /* mm */
};

/* The name of a kind, such as "ball". */
const char *scene_kind_name(scene_kind kind);

/* The classes of the scenes in their light without gain, cast, noise and blur. */
void scene_classes(classes *list);

/* Places everything. 0, or -1 after a message: no room for so many things in what the camera
 * sees. */
int scene_build(const scene_options *options, struct scene *scene);

/* The ray through a place of the picture, in 1/256 pixel from its first pixel's centre, in robot
 * coordinates; and a ray of robot coordinates in those of the field, whose origin is the middle
 * of the centre circle and whose y axis points to the blue goal. */
trace_ray scene_ray(const struct scene *scene, int64_t x_q8, int64_t y_q8);
trace_ray scene_ray_in_field(const struct scene *scene, const trace_ray *ray);

/* A random number that belongs to a seed and a place in its sequence (the finaliser of
 * MurmurHash3). */
uint32_t scene_random(uint32_t seed, uint32_t index);

/*
 * Renders width x height pixels: rgb_q8, three numbers of 8 fraction bits each, and the label of
 * every pixel's centre. Completes the objects of the scene.
 */
void scene_render(struct scene *scene, uint16_t *rgb_q8, uint8_t *labels);

/* What camera and light do to the picture, in this order: blur, gain and cast, noise; rounded to
 * bytes. `scratch` is room for one more picture like rgb_q8. */
void scene_expose(const scene_options *options, uint16_t *rgb_q8, uint16_t *scratch, uint8_t *rgb);

#endif
