#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "decimal.h"
#include "options.h"
#include "report.h"
#include "say.h"
#include "scene.h"
#include "sink.h"
#include "usage.h"

static const char help[] =
    "Usage: pel scene [OPTION]... -o PICTURE\n"
    "\n"
    "Renders what a small robot on a football field sees: balls, cones, posts, a goal and white "
    "lines\n"
    "on a green floor. The same options give the same bytes on every machine, and what is where "
    "is\n"
    "known exactly: material for tests, demonstrations and for tuning without a robot.\n"
    "\n"
    "What to write (at least one; '-' is standard output)\n"
    "  -o PICTURE             the picture: .ppm or .png\n"
    "      --mask MASK.pgm    the class label of every pixel (class + 1; 0 = none), before noise,\n"
    "                         blur and light\n"
    "      --objects LIST.csv what stands where: columns id,kind,class,name,x_mm,y_mm,radius_mm,\n"
    "                         height_mm (on the floor: x to the right, y ahead of the camera) and "
    "what\n"
    "                         the picture shows of it: area,x0,y0,x1,y1,sum_x,sum_y,cx,cy\n"
    "      --classes FILE     a class file that fits the scene's colours\n"
    "\n"
    "What to see\n"
    "      --size WxH         of the picture, default 320x240\n"
    "      --seed N           which scene, default 1\n"
    "      --height MM        of the camera over the floor, 50..2500, default 320\n"
    "      --pitch DEG        how far it looks down, -90..90, default 16\n"
    "      --fov DEG          from the left to the right edge, 10..150, default 62\n"
    "      --balls N          default 4, at most 50\n"
    "      --cones N          default 2, at most 50\n"
    "      --samples N        N x N rays per pixel, 1..8, default 4. With 1 no pixel mixes "
    "colours, and\n"
    "                         picture and mask agree pixel by pixel.\n"
    "\n"
    "Light and camera\n"
    "      --gain X           brightness, default 1.0\n"
    "      --cast R,G,B       how a white sheet of paper looks, default 255,255,255\n"
    "      --noise SIGMA      standard deviation, 0..100, default 0\n"
    "      --blur N           radius of a box filter in pixels, 0..50, default 0\n"
    "\n"
    "Examples\n"
    "  pel scene --seed 7 -o robot.png --classes robot.classes\n"
    "  pel scene --seed 7 --gain 0.7 --cast 255,235,190 --noise 4 -o evening.ppm\n"
    "  pel scene --seed 7 -o - | pel blobs -c robot.classes -\n"
    "  pel scene --seed 7 --samples 1 -o plain.ppm --mask truth.pgm --objects truth.csv\n";

/* What was asked for. */
struct request {
    scene_options scene;
    const char *picture, *mask, *objects, *classes;
};

/* ---- The command line ---------------------------------------------------------------------- */

static int read_count(const char *name, unsigned long min, unsigned long max, unsigned *count)
{
    unsigned long number;
    if (options_number(name, optarg, min, max, &number)) {
        return -1;
    }
    *count = (unsigned)number;
    return 0;
}

static int read_cast(unsigned cast[3])
{
    unsigned value[3];
    char end;
    if (strlen(optarg) > 11 || optarg[strspn(optarg, "0123456789,")] != '\0' ||
        sscanf(optarg, "%3u,%3u,%3u%c", &value[0], &value[1], &value[2], &end) != 3 ||
        value[0] > 255 || value[1] > 255 || value[2] > 255) {
        return say_error("scene", "--cast needs three numbers 0..255 such as 255,235,190, not '%s'",
                         optarg);
    }
    memcpy(cast, value, sizeof value);
    return 0;
}

static int read_positive_milli(const char *name, int32_t max, unsigned *milli)
{
    int32_t value;
    if (decimal_milli("scene", name, optarg, 0, max, &value)) {
        return -1;
    }
    *milli = (unsigned)value;
    return 0;
}

static int read_seed(uint32_t *seed)
{
    unsigned long number;
    if (options_number("--seed", optarg, 0, 0xffffffffu, &number)) {
        return -1;
    }
    *seed = (uint32_t)number;
    return 0;
}

static int read_height(int32_t *height_mm)
{
    unsigned height = 0;
    if (read_count("--height", 50, 2500, &height)) {
        return -1;
    }
    *height_mm = (int32_t)height;
    return 0;
}

/* Takes one option of the scene itself; 0, or -1 after a message. */
static int read_scene_option(int option, scene_options *scene)
{
    switch (option) {
    case 's':
        return options_size(optarg, &scene->width, &scene->height);
    case 'S':
        return read_seed(&scene->seed);
    case 'H':
        return read_height(&scene->height_mm);
    case 'P':
        return decimal_milli("scene", "--pitch", optarg, -90000, 90000, &scene->pitch_mdeg);
    case 'F':
        return decimal_milli("scene", "--fov", optarg, 10000, 150000, &scene->fov_mdeg);
    case 'B':
        return read_count("--balls", 0, SCENE_THINGS_MAX, &scene->balls);
    case 'C':
        return read_count("--cones", 0, SCENE_THINGS_MAX, &scene->cones);
    case 'r':
        return read_count("--samples", 1, 8, &scene->samples);
    case 'G':
        return read_positive_milli("--gain", 16000, &scene->gain_milli);
    case 'T':
        return read_cast(scene->cast);
    case 'N':
        return read_positive_milli("--noise", 100000, &scene->noise_milli);
    default:
        return read_count("--blur", 0, 50, &scene->blur);
    }
}

static const struct option long_options[] = {{"mask", required_argument, NULL, 'm'},
                                             {"objects", required_argument, NULL, 'j'},
                                             {"classes", required_argument, NULL, 'c'},
                                             {"size", required_argument, NULL, 's'},
                                             {"seed", required_argument, NULL, 'S'},
                                             {"height", required_argument, NULL, 'H'},
                                             {"pitch", required_argument, NULL, 'P'},
                                             {"fov", required_argument, NULL, 'F'},
                                             {"balls", required_argument, NULL, 'B'},
                                             {"cones", required_argument, NULL, 'C'},
                                             {"samples", required_argument, NULL, 'r'},
                                             {"gain", required_argument, NULL, 'G'},
                                             {"cast", required_argument, NULL, 'T'},
                                             {"noise", required_argument, NULL, 'N'},
                                             {"blur", required_argument, NULL, 'L'},
                                             {"help", no_argument, NULL, 'h'},
                                             {NULL, 0, NULL, 0}};

static int is_dash(const char *path)
{
    return path && strcmp(path, "-") == 0;
}

/* What is left to check when all options are read: 0, or the exit status. */
static int check(int argc, char **argv, const struct request *request)
{
    if (optind < argc) {
        return usage_error("scene", "'%s' is one word too many", argv[optind]);
    }
    if (!request->picture && !request->mask && !request->objects && !request->classes) {
        return usage_error("scene",
                           "nothing to write: say -o PICTURE, --mask, --objects or --classes");
    }
    if (is_dash(request->picture) + is_dash(request->mask) + is_dash(request->objects) +
            is_dash(request->classes) >
        1) {
        return usage_error("scene", "only one output can go to standard output");
    }
    if ((request->picture && sink_check_picture(request->picture)) ||
        (request->mask && sink_check_picture(request->mask))) {
        return usage_hint("scene");
    }
    return 0;
}

/* Reads the command line: -1 to go on, or an exit status. */
static int parse(int argc, char **argv, struct request *request)
{
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":o:h", long_options, NULL)) != -1) {
        switch (option) {
        case 'h':
            fputs(help, stdout);
            return EXIT_SUCCESS;
        case 'o':
            request->picture = optarg;
            break;
        case 'm':
            request->mask = optarg;
            break;
        case 'j':
            request->objects = optarg;
            break;
        case 'c':
            request->classes = optarg;
            break;
        case '?':
        case ':':
            return usage_bad_option("scene", option, argv);
        default:
            if (read_scene_option(option, &request->scene)) {
                return usage_hint("scene");
            }
        }
    }
    const int status = check(argc, argv, request);
    return status ? status : -1;
}

/* ---- Writing ------------------------------------------------------------------------------- */

/* The options that make this picture again, for the comment in its file. */
static void describe(const scene_options *scene, char *text, size_t size)
{
    snprintf(text, size,
             "pel scene --size %ux%u --seed %" PRIu32 " --height %" PRId32
             " --pitch %s%d.%03d --fov %d.%03d\n--balls %u --cones %u --samples %u --gain %u.%03u "
             "--cast %u,%u,%u --noise %u.%03u --blur %u",
             scene->width, scene->height, scene->seed, scene->height_mm,
             scene->pitch_mdeg < 0 ? "-" : "", abs((int)scene->pitch_mdeg) / 1000,
             abs((int)scene->pitch_mdeg) % 1000, (int)scene->fov_mdeg / 1000,
             (int)scene->fov_mdeg % 1000, scene->balls, scene->cones, scene->samples,
             scene->gain_milli / 1000, scene->gain_milli % 1000, scene->cast[0], scene->cast[1],
             scene->cast[2], scene->noise_milli / 1000, scene->noise_milli % 1000, scene->blur);
}

static int write_picture(const scene_options *options, const char *path, const uint8_t *pixels,
                         pel_format format, const char *comment)
{
    pel_cview view;
    const pel_status status =
        pel_cview_init(pixels, format, PEL_RANGE_FULL, (uint16_t)options->width,
                       (uint16_t)options->height, 0, &view);
    if (status != PEL_OK) {
        return say_error(path, "cannot write a picture of this size: %s", pel_status_name(status));
    }
    return sink_picture(path, &view, comment);
}

static void print_object(FILE *file, const struct scene *scene, const classes *list, unsigned id)
{
    const scene_object *object = &scene->object[id];
    fprintf(file,
            "%u,%s,%d,%s,%" PRId32 ",%" PRId32 ",%" PRId32 ",%" PRId32 ",%" PRIu32
            ",%u,%u,%u,%u,%" PRIu64 ",%" PRIu64 ",",
            id, scene_kind_name(object->kind), (int)object->class_index,
            list->entry[object->class_index].name, object->x_mm, object->y_mm, object->radius_mm,
            object->height_mm, object->area, object->x0, object->y0, object->x1, object->y1,
            object->sum_x, object->sum_y);
    report_ratio(file, object->sum_x, object->area);
    fputc(',', file);
    report_ratio(file, object->sum_y, object->area);
    fputc('\n', file);
}

static int write_objects(const char *path, const struct scene *scene, const classes *list)
{
    FILE *file = report_open(path);
    if (!file) {
        return -1;
    }
    fputs("id,kind,class,name,x_mm,y_mm,radius_mm,height_mm,area,x0,y0,x1,y1,sum_x,sum_y,cx,cy\n",
          file);
    for (unsigned id = 0; id < scene->object_count; id++) {
        print_object(file, scene, list, id);
    }
    return report_close(file, path);
}

/* Everything that was asked for, of a scene that has been rendered. */
static int write_all(const struct request *request, const struct scene *scene, const classes *list,
                     const uint8_t *rgb, const uint8_t *labels)
{
    char comment[512];
    describe(&request->scene, comment, sizeof comment);
    if (request->picture &&
        write_picture(&request->scene, request->picture, rgb, PEL_RGB888, comment)) {
        return -1;
    }
    if (request->mask &&
        write_picture(&request->scene, request->mask, labels, PEL_GRAY8, comment)) {
        return -1;
    }
    if (request->objects && write_objects(request->objects, scene, list)) {
        return -1;
    }
    return request->classes ? classes_write(request->classes, list) : 0;
}

static int render(const struct request *request, struct scene *scene, const classes *list)
{
    const size_t pixels = (size_t)request->scene.width * request->scene.height;
    uint16_t *deep = malloc(2 * 3 * pixels * sizeof *deep);
    uint8_t *bytes = malloc(4 * pixels);
    int result = -1;
    if (!deep || !bytes) {
        say_error(NULL, "out of memory for a picture of %ux%u", request->scene.width,
                  request->scene.height);
    } else {
        scene_render(scene, deep, bytes);
        scene_expose(&request->scene, deep, deep + 3 * pixels, bytes + pixels);
        result = write_all(request, scene, list, bytes + pixels, bytes);
    }
    free(deep);
    free(bytes);
    return result;
}

static int run(int argc, char **argv)
{
    struct request request = {.scene = {.width = 320,
                                        .height = 240,
                                        .seed = 1,
                                        .height_mm = 320,
                                        .pitch_mdeg = 16000,
                                        .fov_mdeg = 62000,
                                        .balls = 4,
                                        .cones = 2,
                                        .samples = 4,
                                        .gain_milli = 1000,
                                        .cast = {255, 255, 255}}};
    static struct scene scene;
    static classes list;
    const int status = parse(argc, argv, &request);
    if (status >= 0) {
        return status;
    }
    scene_classes(&list);
    if (scene_build(&request.scene, &scene) || render(&request, &scene, &list)) {
        return EXIT_BAD_INPUT;
    }
    return EXIT_SUCCESS;
}

const command cmd_scene = {"scene", "render what a robot sees, with the exact truth beside it",
                           help, run};
