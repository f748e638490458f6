#include "benchpeer.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench_opencv.inc"
#include "say.h"

/* A text that can be handed to execvp. */
static char *copy_text(const void *text, size_t length)
{
    char *copy = malloc(length + 1);
    if (copy) {
        memcpy(copy, text, length);
        copy[length] = '\0';
    }
    return copy;
}

/* In the new process; `in` and `out` are its ends of the pipes. */
static void become_python(char *python, char *script, int in, int out)
{
    char dash_c[] = "-c";
    /* Its own name, too: by that a virtual environment finds itself. */
    char *const arguments[] = {python, dash_c, script, NULL};
    if (dup2(in, STDIN_FILENO) < 0 || dup2(out, STDOUT_FILENO) < 0) {
        _exit(127);
    }
    execvp(python, arguments);
    _exit(127);
}

/* Starts the process with its ends of the pipes, which are closed here. 0 or -1. */
static int launch(benchpeer *peer, const char *python, int requests[2], int answers[2])
{
    char *script = copy_text(bench_opencv, sizeof bench_opencv);
    char *name = copy_text(python, strlen(python));
    const pid_t process = script && name ? fork() : -1;
    if (process == 0) {
        close(requests[1]);
        close(answers[0]);
        become_python(name, script, requests[0], answers[1]);
    }
    free(script);
    free(name);
    close(requests[0]);
    close(answers[1]);
    peer->process = process < 0 ? 0 : process;
    peer->to = fdopen(requests[1], "wb");
    peer->from = fdopen(answers[0], "rb");
    return process > 0 && peer->to && peer->from ? 0 : -1;
}

int benchpeer_start(benchpeer *peer, const char *python)
{
    char line[160];
    int requests[2];
    int answers[2];
    snprintf(peer->missing, sizeof peer->missing, "'%.100s' cannot be started", python);
    if (pipe(requests) != 0) {
        return -1;
    }
    if (pipe(answers) != 0) {
        close(requests[0]);
        close(requests[1]);
        return -1;
    }
    fflush(stdout);
    if (launch(peer, python, requests, answers) == 0 && fgets(line, sizeof line, peer->from)) {
        line[strcspn(line, "\n")] = '\0';
        if (sscanf(line, "opencv %31s", peer->version) == 1) {
            return 0;
        }
        snprintf(peer->missing, sizeof peer->missing, "'%.80s' says: %.100s", python, line);
    }
    benchpeer_stop(peer);
    return -1;
}

static int silent(void)
{
    return say_error("bench", "OpenCV's process has ended or does not answer");
}

static int send_form(benchpeer *peer, const bench_picture *picture, bench_form form)
{
    const pel_cview view = benchpicture_view(picture, form);
    const size_t bytes = pel_frame_bytes(view.format, view.width, view.height);
    return fwrite(view.plane[0], 1, bytes, peer->to) == bytes ? 0 : -1;
}

int benchpeer_picture(benchpeer *peer, const bench_picture *picture, unsigned frames)
{
    char line[8];
    if (!peer->process) {
        return 0;
    }
    fprintf(peer->to, "picture %u %u %u %u\n", (unsigned)picture->width, (unsigned)picture->height,
            picture->box_count, frames);
    for (unsigned i = 0; i < picture->box_count; i++) {
        const pel_color_box *box = &picture->box[i];
        const uint8_t sides[6] = {box->y_min, box->y_max, box->u_min,
                                  box->u_max, box->v_min, box->v_max};
        fwrite(sides, 1, sizeof sides, peer->to);
    }
    if (send_form(peer, picture, BENCH_YUYV) || send_form(peer, picture, BENCH_RGB) ||
        fflush(peer->to) != 0 || !fgets(line, sizeof line, peer->from)) {
        return silent();
    }
    return 0;
}

static int take_result(benchpeer *peer, size_t bytes)
{
    if (bytes > peer->capacity) {
        uint8_t *larger = realloc(peer->result, bytes);
        if (!larger) {
            return say_error("bench", "out of memory");
        }
        peer->result = larger;
        peer->capacity = bytes;
    }
    return fread(peer->result, 1, bytes, peer->from) == bytes ? 1 : silent();
}

int benchpeer_prepare(benchpeer *peer, const char *job, size_t *bytes)
{
    char line[64];
    unsigned long count;
    if (!peer->process) {
        return 0;
    }
    fprintf(peer->to, "prepare %s\n", job);
    if (fflush(peer->to) != 0 || !fgets(line, sizeof line, peer->from)) {
        return silent();
    }
    if (strcmp(line, "none\n") == 0) {
        return 0;
    }
    if (sscanf(line, "result %lu", &count) != 1) {
        return silent();
    }
    *bytes = count;
    return take_result(peer, count);
}

int benchpeer_run(benchpeer *peer, unsigned repeat, unsigned count, double *ns)
{
    fprintf(peer->to, "run %u %u\n", repeat, count);
    if (fflush(peer->to) != 0) {
        return silent();
    }
    for (unsigned i = 0; i < count; i++) {
        if (fscanf(peer->from, "%lf", &ns[i]) != 1) {
            return silent();
        }
        ns[i] /= repeat;
    }
    return fgetc(peer->from) == '\n' ? 0 : silent();
}

void benchpeer_stop(benchpeer *peer)
{
    if (peer->to) {
        fclose(peer->to); /* the end of its requests, at which it ends */
    }
    if (peer->from) {
        fclose(peer->from);
    }
    if (peer->process) {
        waitpid(peer->process, NULL, 0);
    }
    free(peer->result);
    peer->to = peer->from = NULL;
    peer->result = NULL;
    peer->capacity = 0;
    peer->process = 0;
}
