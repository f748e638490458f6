#include "recording.h"

#ifdef PEL_HAS_CAMERAS

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "create.h"
#include "numbered.h"
#include "pack.h"
#include "say.h"

static int is_stdout(const recording *to)
{
    return strcmp(to->path, "-") == 0;
}

int recording_check(recording *to)
{
    to->spare = -1;
    if (is_stdout(to)) {
        to->kind = SINK_Y4M;
        return isatty(STDOUT_FILENO)
                   ? say_error("standard output", "is a terminal; send the frames into a pipe or "
                                                  "a file")
                   : 0;
    }
    if (sink_kind_by_path(to->path, &to->kind) || to->kind == SINK_JPEG || to->kind == SINK_PGM) {
        return say_error(to->path, "ends in none of .ppm .png .y4m .raw .yuv");
    }
    char *first = numbered_name(to->path, 0);
    const int status =
        first ? create_check(first, to->force) : say_error(to->path, "out of memory");
    free(first);
    return status;
}

/* The video layout that is nearest to the frame's. 4:2:2 keeps every byte of YUYV and its
 * relatives. */
static pel_format video_format(pel_format format)
{
    if (format == PEL_NV12) {
        return PEL_I420;
    }
    return format == PEL_I420 || format == PEL_GRAY8 ? format : PEL_YUYV;
}

/* A picture in a file of its own. */
static int write_single(recording *to, camera *from, const camera_frame *got)
{
    char comment[1400];
    sink single;
    char *name = numbered_name(to->path, to->frames);
    if (!name) {
        return say_error(to->path, "out of memory");
    }
    FILE *file = create_file(name, to->force);
    int status = -1;
    if (file) {
        snprintf(comment, sizeof comment,
                 "%sframe: sequence %" PRIu64 ", %" PRIu64 ".%06" PRIu64 " s\n",
                 camera_comment(from), got->sequence, got->timestamp_us / 1000000,
                 got->timestamp_us % 1000000);
        sink_attach(&single, file, name, to->kind);
        single.comment = comment;
        status = sink_close(&single, sink_frame(&single, &got->view));
    }
    free(name);
    return status;
}

static int open_stream(recording *to, camera *from)
{
    const capture_settings *settings = camera_settings(from);
    FILE *file = is_stdout(to) ? stdout : create_file(to->path, to->force);
    if (!file) {
        return -1;
    }
    sink_attach(&to->to, file, to->path, to->kind);
    to->to.comment = camera_comment(from);
    to->to.rate_num = settings->rate_num;
    to->to.rate_den = settings->rate_den;
    to->spare = is_stdout(to) ? -1 : dup(fileno(file));
    return 0;
}

/* Ends the file behind its last whole frame; the disk may be full. */
static void cut_off(recording *to)
{
    fclose(to->to.file);
    to->to.file = NULL;
    if (ftruncate(to->spare, (off_t)to->good_bytes) == 0) {
        say_error(to->path, "ends after %lu whole frames", to->frames);
    }
    if (to->frames == 0) {
        remove(to->path);
    }
}

static int write_stream(recording *to, camera *from, const pel_cview *view)
{
    pel_cview made = *view;
    if (to->kind == SINK_Y4M) {
        if (pack_frame(to->path, view, video_format(view->format), view->range, &to->packed)) {
            return -1;
        }
        made = pel_view_to_read(&to->packed.view);
    }
    if (!to->to.file && open_stream(to, from)) {
        return -1;
    }
    int status = sink_frame(&to->to, &made);
    errno = 0;
    if (status == 0 && fflush(to->to.file) != 0) {
        status = say_error(is_stdout(to) ? "standard output" : to->path, "cannot write: %s",
                           errno ? strerror(errno) : "the device took no more");
    }
    if (status && to->spare >= 0) {
        cut_off(to);
    } else if (to->spare >= 0) {
        to->good_bytes = ftello(to->to.file);
    }
    return status;
}

int recording_frame(recording *to, camera *from, const camera_frame *got)
{
    const int single = to->kind == SINK_PNG || to->kind == SINK_PPM;
    const int status = single ? write_single(to, from, got) : write_stream(to, from, &got->view);
    to->frames += status == 0;
    return status;
}

int recording_close(recording *to, int status)
{
    status = sink_close(&to->to, status);
    if (to->spare >= 0) {
        close(to->spare);
    }
    frame_free(&to->packed);
    return status;
}

#else

typedef int recording_empty; /* ISO C wants something in a file */

#endif
