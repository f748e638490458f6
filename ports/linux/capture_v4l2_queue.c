/* The driver's queue: its buffers in our memory, into the queue and out of it. */
#include "v4l2_camera.h"

#include <errno.h>
#include <string.h>
#include <sys/mman.h>

/* A v4l2_buffer with the memory that multi-planar queues need beside it. */
typedef struct description {
    struct v4l2_buffer buffer;
    struct v4l2_plane planes[VIDEO_MAX_PLANES];
} description;

static int is_multi(const v4l2_camera *v4l2)
{
    return v4l2->device.queue == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
}

static void describe(const v4l2_camera *v4l2, unsigned index, description *about)
{
    memset(about, 0, sizeof *about);
    about->buffer.type = v4l2->device.queue;
    about->buffer.memory = V4L2_MEMORY_MMAP;
    about->buffer.index = index;
    if (is_multi(v4l2)) {
        about->buffer.m.planes = about->planes;
        about->buffer.length = VIDEO_MAX_PLANES;
    }
}

static unsigned slot_of(const v4l2_camera *v4l2, unsigned index)
{
    return v4l2->generation * (2 * CAPTURE_BUFFERS_MAX) + index + 1;
}

/* ---- Setting up ---------------------------------------------------------------------------- */

static capture_status request_buffers(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    struct v4l2_requestbuffers request;

    memset(&request, 0, sizeof request);
    request.type = v4l2->device.queue;
    request.memory = V4L2_MEMORY_MMAP;
    request.count = camera->wish.buffers;
    if (v4l2_call(&v4l2->device, VIDIOC_REQBUFS, &request)) {
        return v4l2_fail(camera, "VIDIOC_REQBUFS", errno);
    }
    if (request.count == 0) {
        return capture_fail(camera, CAPTURE_ERR_SYSTEM, "%.200s: the driver gives no buffers",
                            v4l2->device.path);
    }
    v4l2->allocated = 1;
    v4l2->count = request.count < CAPTURE_BUFFERS_MAX ? request.count : CAPTURE_BUFFERS_MAX;
    camera->settings.buffers = v4l2->count;
    return CAPTURE_OK;
}

static capture_status map_buffer(capture *camera, unsigned index)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    const struct v4l2_calls *const calls = camera->calls;
    v4l2_map *const map = &v4l2->maps[index];
    description about;
    uint32_t offset;
    void *memory;

    describe(v4l2, index, &about);
    if (v4l2_call(&v4l2->device, VIDIOC_QUERYBUF, &about.buffer)) {
        return v4l2_fail(camera, "VIDIOC_QUERYBUF", errno);
    }
    map->length = is_multi(v4l2) ? about.planes[0].length : about.buffer.length;
    offset = is_multi(v4l2) ? about.planes[0].m.mem_offset : about.buffer.m.offset;
    if (map->length < v4l2->needed) {
        return capture_fail(camera, CAPTURE_ERR_SYSTEM,
                            "%.200s: its buffers of %lu bytes are too small for frames of %lu",
                            v4l2->device.path, (unsigned long)map->length,
                            (unsigned long)v4l2->needed);
    }
    memory = calls->mmap(calls->user, map->length, v4l2->device.fd, (off_t)offset);
    if (memory == MAP_FAILED) {
        return v4l2_fail(camera, "mmap", errno);
    }
    map->memory = (uint8_t *)memory;
    return CAPTURE_OK;
}

/* 0, or -1 with errno. */
static int queue_buffer(v4l2_camera *v4l2, unsigned index)
{
    description about;

    describe(v4l2, index, &about);
    if (v4l2_call(&v4l2->device, VIDIOC_QBUF, &about.buffer)) {
        return -1;
    }
    v4l2->maps[index].queued = 1;
    return 0;
}

static capture_status stream_on(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    int queue = (int)v4l2->device.queue;

    if (v4l2_call(&v4l2->device, VIDIOC_STREAMON, &queue)) {
        return errno == ENOSPC
                   ? capture_fail(camera, CAPTURE_ERR_SYSTEM,
                                  "%.200s: VIDIOC_STREAMON: the USB bus has not enough bandwidth "
                                  "left; try a smaller size or rate, or another port",
                                  v4l2->device.path)
                   : v4l2_fail(camera, "VIDIOC_STREAMON", errno);
    }
    v4l2->heard_us = v4l2_now_us(camera);
    v4l2->quiet = 0;
    v4l2_track_restart(&v4l2->track);
    return CAPTURE_OK;
}

static capture_status queue_all(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);

    for (unsigned i = 0; i < v4l2->count; i++) {
        if (!v4l2->maps[i].held && queue_buffer(v4l2, i)) {
            return v4l2_fail(camera, "VIDIOC_QBUF", errno);
        }
    }
    return stream_on(camera);
}

/* Makes the driver let go of its buffers. 0, or -1 with errno. */
static int free_buffers(v4l2_camera *v4l2)
{
    struct v4l2_requestbuffers none;

    memset(&none, 0, sizeof none);
    none.type = v4l2->device.queue;
    none.memory = V4L2_MEMORY_MMAP;
    if (v4l2->allocated && v4l2_call(&v4l2->device, VIDIOC_REQBUFS, &none)) {
        return -1;
    }
    v4l2->allocated = 0;
    return 0;
}

capture_status v4l2_begin_stream(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    capture_status status;

    /* It may not have let go of the last ones: old kernels do not while a frame is held. */
    if (free_buffers(v4l2)) {
        return v4l2_fail(camera, "VIDIOC_REQBUFS", errno);
    }
    status = v4l2_confirm_format(camera);
    if (status != CAPTURE_OK) {
        return status;
    }
    status = request_buffers(camera);
    for (unsigned i = 0; i < v4l2->count && status == CAPTURE_OK; i++) {
        status = map_buffer(camera, i);
    }
    if (status == CAPTURE_OK) {
        status = queue_all(camera);
    }
    if (status != CAPTURE_OK) {
        v4l2_end_stream(camera, 1);
    }
    return status;
}

/* ---- Letting go ---------------------------------------------------------------------------- */

static void release_map(capture *camera, unsigned index, int keep_held)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    v4l2_map *const map = &v4l2->maps[index];
    unsigned free_place = 0;

    if (map->memory && map->held && keep_held) {
        while (v4l2->retired[free_place].memory) { /* there are as many places as frames held */
            free_place++;
        }
        v4l2->retired[free_place].memory = map->memory;
        v4l2->retired[free_place].length = map->length;
        v4l2->retired[free_place].slot = slot_of(v4l2, index);
    } else if (map->memory) {
        camera->calls->munmap(camera->calls->user, map->memory, map->length);
    }
    memset(map, 0, sizeof *map);
}

static void release_retired(capture *camera, v4l2_retired *retired)
{
    camera->calls->munmap(camera->calls->user, retired->memory, retired->length);
    memset(retired, 0, sizeof *retired);
}

void v4l2_end_stream(capture *camera, int keep_held)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    const int had_buffers = v4l2->count > 0;
    int queue = (int)v4l2->device.queue;
    int off = 0;

    if (had_buffers) { /* even if they are only queued: gets them out of the queue */
        off = v4l2_call(&v4l2->device, VIDIOC_STREAMOFF, &queue);
    }
    for (unsigned i = 0; i < CAPTURE_BUFFERS_MAX; i++) {
        release_map(camera, i, keep_held);
        if (!keep_held && v4l2->retired[i].memory) {
            release_retired(camera, &v4l2->retired[i]);
        }
    }
    if (!keep_held) {
        v4l2->held = 0;
    }
    v4l2->count = 0;
    v4l2->generation++;
    if (had_buffers && v4l2->device.fd >= 0 && free_buffers(v4l2) && (off || errno == ENODEV)) {
        /* Neither stops nor lets go: closing the device is what is left. */
        v4l2->stubborn = errno != ENODEV;
        v4l2_device_close(&v4l2->device);
        v4l2->lost = 1;
        v4l2->retry_us = 0;
        v4l2->lost_us = v4l2_now_us(camera);
    }
}

capture_status v4l2_cycle_stream(capture *camera)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    int queue = (int)v4l2->device.queue;

    if (v4l2_call(&v4l2->device, VIDIOC_STREAMOFF, &queue)) {
        return v4l2_fail(camera, "VIDIOC_STREAMOFF", errno);
    }
    for (unsigned i = 0; i < v4l2->count; i++) {
        v4l2->maps[i].queued = 0;
    }
    return queue_all(camera);
}

/* ---- Buffers come and go ------------------------------------------------------------------- */

void v4l2_queue(capture *camera, unsigned index)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);

    /* Before a restart the driver may not take it, and the restart queues everything. */
    if (!v4l2->restart_due && queue_buffer(v4l2, index)) {
        v4l2_trouble(camera, "VIDIOC_QBUF", errno);
    }
}

/* How many bytes arrived, and where they start; 0 if the driver tells nonsense. */
static int read_filling(const v4l2_camera *v4l2, const description *about, size_t *start,
                        size_t *end)
{
    const size_t length = v4l2->maps[about->buffer.index].length;

    *start = is_multi(v4l2) ? about->planes[0].data_offset : 0;
    *end = is_multi(v4l2) ? about->planes[0].bytesused : about->buffer.bytesused;
    return *end <= length && *start <= *end;
}

static int64_t time_of(const struct v4l2_buffer *buffer)
{
    return (int64_t)buffer->timestamp.tv_sec * 1000000 + (int64_t)buffer->timestamp.tv_usec;
}

/* Sorts out damaged and short buffers; fills *filled for good ones. */
static v4l2_outcome judge(capture *camera, const description *about, v4l2_filled *filled)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    const v4l2_map *const map = &v4l2->maps[about->buffer.index];
    size_t start;
    size_t end;

    if ((about->buffer.flags & V4L2_BUF_FLAG_ERROR) || !read_filling(v4l2, about, &start, &end)) {
        camera->counts.damaged++;
        return V4L2_DROPPED;
    }
    if (end - start < v4l2->needed) {
        camera->counts.short_frames++;
        return V4L2_DROPPED;
    }
    if (map->length - start < v4l2->needed) {
        camera->counts.damaged++;
        return V4L2_DROPPED;
    }
    if (camera->settings.compressed &&
        (map->memory[start] != 0xFF || map->memory[start + 1] != 0xD8)) {
        camera->counts.damaged++; /* no JPEG begins otherwise */
        return V4L2_DROPPED;
    }
    filled->index = about->buffer.index;
    filled->bytes = map->memory + start;
    filled->byte_count = end - start;
    return V4L2_FRAME;
}

v4l2_outcome v4l2_dequeue(capture *camera, v4l2_filled *filled)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    int64_t time_us;
    description about;

    describe(v4l2, 0, &about);
    if (v4l2_call(&v4l2->device, VIDIOC_DQBUF, &about.buffer)) {
        if (errno == EAGAIN) {
            return V4L2_NOTHING;
        }
        v4l2_trouble(camera, "VIDIOC_DQBUF", errno);
        return V4L2_TROUBLE;
    }
    if (about.buffer.index >= v4l2->count || !v4l2->maps[about.buffer.index].queued) {
        v4l2_trouble(camera, "VIDIOC_DQBUF: a buffer that it did not have", EIO);
        return V4L2_TROUBLE;
    }
    v4l2->maps[about.buffer.index].queued = 0;
    v4l2->heard_us = v4l2_now_us(camera);
    v4l2->quiet = 0;
    if (judge(camera, &about, filled) == V4L2_DROPPED) {
        v4l2_track_drop(&v4l2->track);
        v4l2_queue(camera, about.buffer.index);
        return v4l2->restart_due || v4l2->lost ? V4L2_TROUBLE : V4L2_DROPPED;
    }
    v4l2->failures = 0;
    time_us = time_of(&about.buffer);
    if (time_us == 0) { /* a driver without a clock */
        time_us = (int64_t)v4l2->heard_us;
    }
    camera->counts.missed += v4l2_track_take(&v4l2->track, about.buffer.sequence, time_us);
    filled->sequence = v4l2->track.sequence;
    filled->timestamp_us = v4l2->track.timestamp;
    return V4L2_FRAME;
}

/* ---- With the caller ----------------------------------------------------------------------- */

void v4l2_hand_out(capture *camera, const v4l2_filled *filled, capture_frame *frame)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    const capture_settings *const settings = &camera->settings;

    v4l2->maps[filled->index].held = 1;
    v4l2->held++;
    frame->slot = slot_of(v4l2, filled->index);
    frame->bytes = filled->bytes;
    frame->byte_count = filled->byte_count;
    frame->sequence = filled->sequence;
    frame->timestamp_us = filled->timestamp_us;
    if (settings->compressed) {
        return;
    }
    /* Cannot fail: v4l2_confirm_format has tried it. */
    pel_cview_init(filled->bytes, settings->format, settings->range, (uint16_t)settings->width,
                   (uint16_t)settings->height, (int32_t)settings->bytes_per_line, &frame->view);
}

static int give_back_retired(capture *camera, unsigned slot)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);

    for (unsigned i = 0; i < CAPTURE_BUFFERS_MAX; i++) {
        if (v4l2->retired[i].memory && v4l2->retired[i].slot == slot) {
            release_retired(camera, &v4l2->retired[i]);
            v4l2->held--;
            return 1;
        }
    }
    return 0;
}

capture_status v4l2_give_back(capture *camera, const capture_frame *frame)
{
    v4l2_camera *const v4l2 = v4l2_state(camera);
    const unsigned index = (frame->slot - 1) % (2 * CAPTURE_BUFFERS_MAX);

    if (give_back_retired(camera, frame->slot)) {
        return CAPTURE_OK;
    }
    if ((frame->slot - 1) / (2 * CAPTURE_BUFFERS_MAX) < v4l2->generation) {
        return CAPTURE_OK; /* of a stream that has ended: all was taken back then */
    }
    if (index >= v4l2->count || frame->slot != slot_of(v4l2, index) || !v4l2->maps[index].held) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "not a frame that is out");
    }
    v4l2->maps[index].held = 0;
    v4l2->held--;
    v4l2_queue(camera, index);
    return CAPTURE_OK;
}
