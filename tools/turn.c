#include "turn.h"

#include <stdlib.h>

#include "options.h"
#include "say.h"
#include "usage.h"
#include "walk.h"

int turn_option(turn *job, int option, int argc, char **argv)
{
    int failed = 0;
    switch (option) {
    case OPTION_RAW:
    case OPTION_RANGE:
        failed = options_input(option, argc, argv, &job->input) < 0;
        break;
    case 'Y':
        job->kind = PLAIN_GRAY;
        break;
    default:
        return usage_bad_option(job->command, option, argv);
    }
    return failed ? usage_hint(job->command) : -1;
}

int turn_files(turn *job, int argc, char **argv)
{
    int status = EXIT_SUCCESS;
    if (argc - optind != 2) {
        return usage_error(job->command, "IN and OUT wanted, %d given", argc - optind);
    }
    job->in = argv[optind];
    return outlet_begin(&job->to, job->command, job->in, argv[optind + 1], &status) ? status : -1;
}

static int visit(void *user, const char *path, unsigned long number, const pel_cview *view)
{
    turn *job = user;
    (void)number;
    if (plain_make(path, view, job->kind, &job->picture)) {
        return -1;
    }
    const pel_cview picture = pel_view_to_read(&job->picture.view);
    return job->make(job->user, path, &picture);
}

int turn_run(turn *job)
{
    const int failed = walk_frames(&job->in, 1, &job->input, visit, job);
    const int status = outlet_close(&job->to, failed);
    frame_free(&job->picture);
    return status ? EXIT_BAD_INPUT : EXIT_SUCCESS;
}
