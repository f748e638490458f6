/* Buffers, frames and what they hold. */
#include "replay.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Pixels -------------------------------------------------------------------------------- */

/* The first four bytes of a frame are its id. */
uint8_t replay_byte(uint32_t id, unsigned plane, unsigned row, unsigned column)
{
    const uint32_t place = (uint32_t)(plane << 28 | row << 14 | column);
    uint32_t mixed = id * 2654435761u ^ (place + 0x7F4A7C15u) * 2246822519u;

    if (plane == 0 && row == 0 && column < 4) {
        return (uint8_t)(id >> (8 * column));
    }
    mixed ^= mixed >> 15;
    mixed *= 3266489917u;
    return (uint8_t)(mixed >> 24);
}

/* Rows of a plane; padding gets what no frame should show. */
static void fill_plane(uint8_t *at, uint32_t id, unsigned plane, unsigned rows, unsigned row_bytes,
                       unsigned stride)
{
    for (unsigned row = 0; row < rows; row++) {
        for (unsigned column = 0; column < row_bytes; column++) {
            at[(size_t)row * stride + column] = replay_byte(id, plane, row, column);
        }
    }
}

static void fill_compressed(const replay_node *node, uint8_t *bytes, size_t length, uint32_t id,
                            replay_kind kind)
{
    if (node->jpeg) {
        memcpy(bytes, node->jpeg, node->jpeg_bytes);
    } else {
        bytes[0] = 0xFF;
        bytes[1] = 0xD8;
        for (unsigned i = 2; i < length; i++) {
            bytes[i] = replay_byte(id, 0, 0, i - 2);
        }
    }
    if (kind == REPLAY_NO_MARK) {
        bytes[0] = 0;
    }
}

static void fill(replay *world, const replay_node *node, const replay_buffer *buffer)
{
    const replay_memory *const memory = &world->memories[buffer->memory];
    const unsigned stride = replay_stride(node);
    const unsigned row_bytes = stride - node->stride_extra;
    uint8_t *const at = memory->bytes + node->data_offset;
    const size_t chroma = (size_t)stride * node->height;

    memset(memory->bytes, 0xEE, memory->length);
    if (stride == 0) {
        fill_compressed(node, at, memory->length - node->data_offset, buffer->id, buffer->kind);
        return;
    }
    fill_plane(at, buffer->id, 0, node->height, row_bytes, stride);
    if (node->fourcc == V4L2_PIX_FMT_NV12) {
        fill_plane(at + chroma, buffer->id, 1, node->height / 2, row_bytes, stride);
    } else if (node->fourcc == V4L2_PIX_FMT_YUV420) {
        fill_plane(at + chroma, buffer->id, 1, node->height / 2, row_bytes / 2, stride / 2);
        fill_plane(at + chroma + (size_t)stride / 2 * (node->height / 2), buffer->id, 2,
                   node->height / 2, row_bytes / 2, stride / 2);
    }
}

/* ---- Checking a frame ---------------------------------------------------------------------- */

const replay_entry *replay_find(const replay *world, uint32_t id)
{
    const replay_entry *const entry = &world->log[id % REPLAY_LOG];

    return entry->id == id && id != 0 ? entry : NULL;
}

static int plane_is_right(const capture_frame *frame, uint32_t id, unsigned plane, unsigned rows,
                          unsigned row_bytes)
{
    const uint8_t *const at = frame->view.plane[plane];
    const ptrdiff_t stride = frame->view.stride_bytes[plane];

    for (unsigned row = 0; row < rows; row++) {
        for (unsigned column = 0; column < row_bytes; column++) {
            if (at[(ptrdiff_t)row * stride + (ptrdiff_t)column] !=
                replay_byte(id, plane, row, column)) {
                return 0;
            }
        }
    }
    return 1;
}

static const char *check_pixels(const capture_settings *settings, const capture_frame *frame,
                                uint32_t id)
{
    const unsigned row_bytes = pel_row_bytes(settings->format, (uint16_t)settings->width);
    const unsigned half = settings->height / 2;

    if (frame->view.width != settings->width || frame->view.height != settings->height ||
        frame->view.format != settings->format || frame->view.range != settings->range) {
        return "its view is not that of the settings";
    }
    if (!plane_is_right(frame, id, 0, settings->height, row_bytes)) {
        return "wrong pixels";
    }
    if (settings->fourcc == V4L2_PIX_FMT_NV12 && !plane_is_right(frame, id, 1, half, row_bytes)) {
        return "wrong chroma";
    }
    if (settings->fourcc == V4L2_PIX_FMT_YUV420 &&
        (!plane_is_right(frame, id, 1, half, row_bytes / 2) ||
         !plane_is_right(frame, id, 2, half, row_bytes / 2))) {
        return "wrong chroma";
    }
    return NULL;
}

static uint32_t id_at(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

const char *replay_check_frame(const replay *world, const capture_settings *settings,
                               const capture_frame *frame, uint32_t *id)
{
    const replay_entry *entry;

    *id = 0;
    if (!frame->bytes || frame->byte_count < 6) {
        return "it has no bytes";
    }
    *id = id_at(frame->bytes + (settings->compressed ? 2 : 0));
    entry = replay_find(world, *id);
    if (!entry) {
        return "no such frame was made";
    }
    if (entry->kind != REPLAY_GOOD) {
        return "it is damaged or short";
    }
    if (!entry->taken) {
        return "the driver still has it";
    }
    if (!settings->compressed) {
        return check_pixels(settings, frame, *id);
    }
    for (unsigned i = 2; i < frame->byte_count; i++) {
        if (frame->bytes[i] != replay_byte(*id, 0, 0, i - 2)) {
            return "wrong bytes";
        }
    }
    return frame->view.plane[0] ? "compressed, but it has a view" : NULL;
}

/* ---- Frames are made ----------------------------------------------------------------------- */

static replay_kind next_kind(replay *world, replay_node *node)
{
    if (node->plan_at < node->plan_count) {
        return node->plan[node->plan_at++];
    }
    if (replay_chance(world, node->damage)) {
        return replay_chance(world, 300) ? REPLAY_OVERLONG : REPLAY_DAMAGED;
    }
    if (replay_chance(world, node->shorten)) {
        return REPLAY_SHORT;
    }
    return replay_chance(world, node->lose) ? REPLAY_LOST : REPLAY_GOOD;
}

static int64_t time_of_frame(const replay_node *node, uint64_t at_us)
{
    int64_t time_us = node->first_time_us + (int64_t)at_us;

    if (node->time_period_us > 0 && time_us >= node->time_low_us + node->time_period_us) {
        time_us -= node->time_period_us;
    }
    return time_us;
}

static void make_frame(replay *world, replay_node *node, uint64_t at_us)
{
    const replay_kind kind = next_kind(world, node);
    const uint32_t sequence = node->sequence++;
    replay_buffer *buffer;
    replay_entry *entry;

    if (kind == REPLAY_LOST || node->waiting_count == 0) {
        node->lost_now++;
        return;
    }
    buffer = &node->buffers[node->waiting[0]];
    node->filled[node->filled_count++] = node->waiting[0];
    node->waiting_count--;
    memmove(node->waiting, node->waiting + 1, node->waiting_count * sizeof node->waiting[0]);
    buffer->queued = 2;
    buffer->id = world->next_id++;
    buffer->kind = kind;
    buffer->sequence = node->no_sequence ? 0 : sequence;
    buffer->time_us = node->no_time ? 0 : time_of_frame(node, at_us);
    buffer->lost_before = node->lost_now;
    node->lost_now = 0;
    fill(world, node, buffer);
    entry = &world->log[buffer->id % REPLAY_LOG];
    entry->id = buffer->id;
    entry->kind = kind;
    entry->made_us = at_us;
    entry->taken = 0;
}

void replay_advance(replay *world, replay_node *node)
{
    while (node->streaming && node->next_us <= world->now_us) {
        if (!node->stalled && !node->broken) {
            make_frame(world, node, node->next_us);
        }
        node->next_us += 1000000 / (node->rate ? node->rate : 30);
    }
}

/* ---- The queue ----------------------------------------------------------------------------- */

void replay_drop_buffers(replay *world, replay_node *node)
{
    for (unsigned i = 0; i < node->buffer_count; i++) {
        world->memories[node->buffers[i].memory].owned = 0;
        replay_release(world, node->buffers[i].memory);
    }
    memset(node->buffers, 0, sizeof node->buffers);
    node->buffer_count = node->waiting_count = node->filled_count = 0;
    node->streaming = 0;
    node->owner = -1;
}

static int is_mapped(const replay *world, const replay_node *node)
{
    for (unsigned i = 0; i < node->buffer_count; i++) {
        if (world->memories[node->buffers[i].memory].mapped) {
            return 1;
        }
    }
    return 0;
}

static int take_memory(replay *world, size_t length)
{
    for (int i = 0; i < REPLAY_MEMORIES; i++) {
        replay_memory *const memory = &world->memories[i];

        if (!memory->owned && !memory->mapped) {
            memory->bytes = (uint8_t *)malloc(length);
            memory->length = length;
            memory->owned = 1;
            return memory->bytes ? i : -1;
        }
    }
    return -1;
}

static int request_buffers(replay *world, int handle, struct v4l2_requestbuffers *request)
{
    replay_node *const node = &world->nodes[world->handles[handle].node];
    const unsigned least = node->buffers_min ? node->buffers_min : 2;
    const unsigned most = node->buffers_max ? node->buffers_max : 32;

    if (request->type != replay_queue_type(node) || request->memory != V4L2_MEMORY_MMAP) {
        return replay_errno(EINVAL);
    }
    if ((node->owner >= 0 && node->owner != handle) ||
        (node->keeps_mapped && is_mapped(world, node))) {
        return replay_errno(EBUSY);
    }
    replay_drop_buffers(world, node);
    if (request->count == 0) {
        return 0;
    }
    if (!node->format_set) {
        return replay_errno(EINVAL);
    }
    request->count = request->count < least ? least : request->count;
    request->count = request->count > most ? most : request->count;
    for (unsigned i = 0; i < request->count; i++) {
        node->buffers[i].memory =
            take_memory(world, replay_frame_bytes(node) + node->data_offset - node->buffer_cut);
        if (node->buffers[i].memory < 0) {
            return replay_errno(ENOMEM);
        }
        node->buffer_count++;
    }
    node->owner = handle;
    return 0;
}

static int query_buffer(const replay *world, const replay_node *node, struct v4l2_buffer *buffer)
{
    const uint32_t offset = buffer->index * 1048576;
    uint32_t length;

    if (buffer->index >= node->buffer_count) {
        return replay_errno(EINVAL);
    }
    length = (uint32_t)world->memories[node->buffers[buffer->index].memory].length;
    if (buffer->type == V4L2_BUF_TYPE_VIDEO_CAPTURE) {
        buffer->length = length;
        buffer->m.offset = offset;
    } else {
        buffer->m.planes[0].length = length;
        buffer->m.planes[0].m.mem_offset = offset;
        buffer->length = 1;
    }
    return 0;
}

static int queue(replay *world, replay_node *node, const struct v4l2_buffer *buffer)
{
    replay_buffer *const here = &node->buffers[buffer->index % REPLAY_BUFFERS];

    if (buffer->index >= node->buffer_count) {
        return replay_errno(EINVAL);
    }
    if (here->queued) {
        printf("misuse: a buffer is queued twice\n");
        world->misuse++;
        return replay_errno(EINVAL);
    }
    if (node->broken) {
        return replay_errno(EIO);
    }
    here->queued = 1;
    node->waiting[node->waiting_count++] = buffer->index;
    return 0;
}

static int is_planar(uint32_t fourcc)
{
    return fourcc == V4L2_PIX_FMT_NV12 || fourcc == V4L2_PIX_FMT_YUV420;
}

/* How many bytes it says it has. */
static uint32_t bytes_used(const replay *world, const replay_node *node, const replay_buffer *from)
{
    const uint32_t length = (uint32_t)world->memories[from->memory].length;
    const uint32_t whole = node->jpeg ? (uint32_t)node->jpeg_bytes + node->data_offset : length;

    switch (from->kind) {
    case REPLAY_SHORT:
        return from->id % 2 == 0 || replay_stride(node) == 0
                   ? node->data_offset
                   : whole - node->size_extra - node->stride_extra - 1;
    case REPLAY_OVERLONG:
        return length + 1 + from->id % 1000;
    default:
        /* Of YU12 the last row has half the padding, of NV12 it may have half of it. */
        return node->no_tail && !node->jpeg && replay_stride(node) > 0
                   ? whole - node->size_extra -
                         node->stride_extra / (is_planar(node->fourcc) ? 2 : 1)
                   : whole;
    }
}

static void count_taken(replay *world, replay_node *node, const replay_buffer *from)
{
    node->taken++;
    node->lost_pending += from->lost_before;
    world->log[from->id % REPLAY_LOG].taken = 1;
    if (from->kind == REPLAY_SHORT) {
        world->counts.short_frames++;
    } else if (from->kind != REPLAY_GOOD) {
        world->counts.damaged++;
    } else {
        world->counts.good++;
        if (node->good_taken && !node->no_sequence) {
            world->counts.missed += node->lost_pending;
        }
        node->good_taken = 1;
        node->lost_pending = 0;
    }
}

/* For nonsense that can be seen through: a buffer that was not queued, or none at all. */
static unsigned find_not_queued(const replay_node *node)
{
    for (unsigned i = 0; i < node->buffer_count; i++) {
        if (node->bad_index == REPLAY_NOT_QUEUED && !node->buffers[i].queued) {
            return i;
        }
    }
    return node->buffer_count + 3;
}

static int dequeue(replay *world, replay_node *node, struct v4l2_buffer *buffer)
{
    replay_buffer *from;
    uint32_t used;

    if (node->broken || !node->streaming) {
        return replay_errno(node->broken ? EIO : EINVAL);
    }
    if (node->unplug_after > 0 && node->taken >= node->unplug_after) {
        replay_unplug(world, node);
        return replay_errno(ENODEV);
    }
    if (node->filled_count == 0) {
        return replay_errno(EAGAIN);
    }
    if (node->bad_index) {
        buffer->index = find_not_queued(node);
        node->bad_index = 0;
        return 0;
    }
    from = &node->buffers[node->filled[0]];
    buffer->index = node->filled[0];
    node->filled_count--;
    memmove(node->filled, node->filled + 1, node->filled_count * sizeof node->filled[0]);
    from->queued = 0;
    used = bytes_used(world, node, from);
    buffer->flags = from->kind == REPLAY_DAMAGED ? V4L2_BUF_FLAG_ERROR : 0;
    buffer->sequence = from->kind == REPLAY_DAMAGED ? 0 : from->sequence;
    buffer->timestamp.tv_usec = (suseconds_t)((from->time_us % 1000000 + 1000000) % 1000000);
    buffer->timestamp.tv_sec = (time_t)((from->time_us - buffer->timestamp.tv_usec) / 1000000);
    if (buffer->type == V4L2_BUF_TYPE_VIDEO_CAPTURE) {
        buffer->bytesused = used;
    } else {
        buffer->m.planes[0].bytesused = used;
        buffer->m.planes[0].data_offset = node->data_offset;
    }
    count_taken(world, node, from);
    return 0;
}

static int stream_on(replay *world, int handle)
{
    replay_node *const node = &world->nodes[world->handles[handle].node];

    if (node->buffer_count == 0 || node->broken) {
        return replay_errno(node->broken ? EIO : EINVAL);
    }
    if (node->streaming) {
        printf("misuse: the stream is started twice\n");
        world->misuse++;
        return 0;
    }
    node->streaming = 1;
    node->stalled = 0;
    node->sequence = node->first_sequence;
    node->lost_now = node->lost_pending = 0;
    node->good_taken = 0;
    node->stream_us = world->now_us;
    node->next_us = world->now_us + 1000;
    world->counts.stream_ons++;
    world->counts.first_stream_ons += !world->handles[handle].streamed;
    world->handles[handle].streamed = 1;
    return 0;
}

static int stream_off(replay_node *node)
{
    node->streaming = 0;
    node->broken = 0;
    node->waiting_count = node->filled_count = 0;
    for (unsigned i = 0; i < node->buffer_count; i++) {
        node->buffers[i].queued = 0;
    }
    return 0;
}

int replay_ioctl_queue(replay *world, int handle, unsigned long request, void *argument)
{
    replay_node *const node = &world->nodes[world->handles[handle].node];
    struct v4l2_buffer *const buffer = (struct v4l2_buffer *)argument;

    if (request == VIDIOC_REQBUFS) {
        return request_buffers(world, handle, (struct v4l2_requestbuffers *)argument);
    }
    if (node->owner != handle) {
        return replay_errno(EBUSY);
    }
    switch (request) {
    case VIDIOC_QUERYBUF:
        return query_buffer(world, node, buffer);
    case VIDIOC_QBUF:
        return queue(world, node, buffer);
    case VIDIOC_DQBUF:
        return dequeue(world, node, buffer);
    case VIDIOC_STREAMON:
        return stream_on(world, handle);
    case VIDIOC_STREAMOFF:
        return stream_off(node);
    default:
        return replay_errno(ENOTTY);
    }
}
