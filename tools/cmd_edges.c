#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "options.h"
#include "say.h"
#include "turn.h"
#include "usage.h"

static const char help[] =
    "Usage: pel edges [OPTION]... IN OUT\n"
    "\n"
    "Finds thin edges, white on black (Canny 1986): pixels whose gradient |gx| + |gy| of Sobel is "
    "over\n"
    "--low and a maximum across the edge, and that are linked to one over --high. Works on the "
    "luma of\n"
    "a colour picture.\n"
    "\n"
    "      --low N              0..2040, default 100\n"
    "      --high N             0..2040, default 200, or --low if that is higher\n"
    "      --link HOW           how weak edges follow from strong ones:\n"
    "                             whole   over the whole picture, exact (default)\n"
    "                             rows    with three rows of memory: downward without end, upward "
    "by\n"
    "                                     one row, as a robot without a frame buffer can\n"
    "                             none    not at all: strong ones white, weak ones "
    "gray\n" OPTIONS_BACKEND_HELP TURN_HELP "\n"
    "Examples\n"
    "  pel edges robot.ppm edges.png\n"
    "  pel edges --low 200 --high 500 robot.ppm strong.pgm\n"
    "  pel edges --link none robot.ppm candidates.pgm\n";

enum { LOW_DEFAULT = 100, HIGH_DEFAULT = 200, MAGNITUDE_MAX = 2040 };

typedef enum link_how { LINK_WHOLE, LINK_ROWS, LINK_NONE } link_how;

struct job {
    turn turn;
    unsigned long low, high;
    int has_low, has_high;
    pel_backend backend;
    link_how how;
    frame map;
};

static int read_how(link_how *how)
{
    static const char *const names[] = {"whole", "rows", "none"};
    for (int i = 0; i < 3; i++) {
        if (options_same_word(optarg, names[i])) {
            *how = (link_how)i;
            return 0;
        }
    }
    return say_error("edges", "--link is whole, rows or none, not '%s'", optarg);
}

/* Takes an option of its own: 0, -1 after a message, or 1 if it is none. */
static int take_option(int option, struct job *job)
{
    switch (option) {
    case 'l':
        job->has_low = 1;
        return options_number("--low", optarg, 0, MAGNITUDE_MAX, &job->low);
    case 'u':
        job->has_high = 1;
        return options_number("--high", optarg, 0, MAGNITUDE_MAX, &job->high);
    case OPTION_BACKEND:
        return options_backend(optarg, &job->backend);
    case 'k':
        return read_how(&job->how);
    default:
        return 1;
    }
}

static int settle_thresholds(struct job *job)
{
    if (!job->has_low) {
        job->low = job->has_high && job->high < LOW_DEFAULT ? job->high : LOW_DEFAULT;
    }
    if (!job->has_high) {
        job->high = job->low > HIGH_DEFAULT ? job->low : HIGH_DEFAULT;
    }
    return job->low > job->high
               ? usage_error("edges", "--low %lu is over --high %lu", job->low, job->high)
               : -1;
}

static int parse(int argc, char **argv, struct job *job)
{
    static const struct option long_options[] = {{"low", required_argument, NULL, 'l'},
                                                 {"high", required_argument, NULL, 'u'},
                                                 {"link", required_argument, NULL, 'k'},
                                                 OPTIONS_BACKEND,
                                                 TURN_OPTIONS};
    int option;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":h", long_options, NULL)) != -1) {
        if (option == 'h') {
            fputs(help, stdout);
            return EXIT_SUCCESS;
        }
        const int taken = take_option(option, job);
        const int status = taken > 0   ? turn_option(&job->turn, option, argc, argv)
                           : taken < 0 ? usage_hint("edges")
                                       : -1;
        if (status >= 0) {
            return status;
        }
    }
    const int status = settle_thresholds(job);
    return status >= 0 ? status : turn_files(&job->turn, argc, argv);
}

static pel_status map_edges(const struct job *job, const pel_cview *picture)
{
    pel_canny_config config = {0};
    config.low = (uint16_t)job->low;
    config.high = (uint16_t)job->high;
    config.backend = job->backend;
    config.work_bytes = PEL_CANNY_BYTES(picture->width);
    config.work = malloc(config.work_bytes);
    const pel_status status =
        config.work ? pel_canny_frame(&config, picture, &job->map.view) : PEL_ERR_SPACE;
    free(config.work);
    return status;
}

static pel_status link_whole(const pel_view *map)
{
    const uint32_t room = (uint32_t)map->width * map->height;
    pel_place *stack = malloc(sizeof *stack * room); /* without it the same takes longer */
    const pel_status status = pel_canny_hysteresis(map, stack, stack ? room : 0);
    free(stack);
    return status;
}

static pel_status link_rows(const pel_view *map)
{
    pel_status status = PEL_OK;
    for (unsigned y = 0; status == PEL_OK && y < map->height; y++) {
        status = pel_canny_link_row(y > 0 ? plain_row(map, y - 1) : NULL,
                                    y + 1u < map->height ? plain_row(map, y + 1) : NULL, map->width,
                                    plain_row(map, y));
    }
    return status;
}

static int make(void *user, const char *path, const pel_cview *picture)
{
    struct job *job = user;
    if (frame_resize(&job->map, PEL_GRAY8, PEL_RANGE_FULL, picture->width, picture->height)) {
        return say_error(path, "out of memory");
    }
    pel_status status = map_edges(job, picture);
    if (status == PEL_OK && job->how != LINK_NONE) {
        status = job->how == LINK_WHOLE ? link_whole(&job->map.view) : link_rows(&job->map.view);
    }
    if (status != PEL_OK) {
        return say_error(path, "its edges cannot be found: %s",
                         status == PEL_ERR_SPACE ? "out of memory" : pel_status_name(status));
    }
    const pel_cview map = pel_view_to_read(&job->map.view);
    return outlet_view(&job->turn.to, path, &map);
}

static int run(int argc, char **argv)
{
    static struct job job;
    job.turn.command = "edges";
    job.turn.make = make;
    job.turn.user = &job;
    job.turn.kind = PLAIN_GRAY;
    int status = parse(argc, argv, &job);
    if (status < 0) {
        status = turn_run(&job.turn);
        frame_free(&job.map);
    }
    return status;
}

const command cmd_edges = {"edges", "find thin edges (Canny)", help, run};
