/* Formats, sizes, rates and what a frame of them looks like. */
#include "replay.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

uint32_t replay_queue_type(const replay_node *node)
{
    return node->caps & V4L2_CAP_VIDEO_CAPTURE ? V4L2_BUF_TYPE_VIDEO_CAPTURE
                                               : V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
}

/* Bits per pixel in the first plane and in all, as the kernel's documentation of each format says:
 * a table of its own, not the one that is tested. */
static void bits_of(uint32_t fourcc, unsigned *first, unsigned *all)
{
    switch (fourcc) {
    case V4L2_PIX_FMT_RGB24:
    case V4L2_PIX_FMT_BGR24:
        *first = *all = 24;
        break;
    case V4L2_PIX_FMT_NV12:
    case V4L2_PIX_FMT_YUV420:
        *first = 8;
        *all = 12;
        break;
    case V4L2_PIX_FMT_GREY:
    case V4L2_PIX_FMT_SRGGB8:
    case V4L2_PIX_FMT_SGRBG8:
    case V4L2_PIX_FMT_SGBRG8:
    case V4L2_PIX_FMT_SBGGR8:
        *first = *all = 8;
        break;
    case V4L2_PIX_FMT_MJPEG:
    case V4L2_PIX_FMT_JPEG:
        *first = *all = 0;
        break;
    default:
        *first = *all = 16;
        break;
    }
}

unsigned replay_stride(const replay_node *node)
{
    unsigned first;
    unsigned all;

    bits_of(node->fourcc, &first, &all);
    return first ? node->width * first / 8 + node->stride_extra : 0;
}

uint32_t replay_frame_bytes(const replay_node *node)
{
    unsigned first;
    unsigned all;

    bits_of(node->fourcc, &first, &all);
    if (first == 0) {
        return node->jpeg ? 16384 : 400;
    }
    return replay_stride(node) * node->height * all / first + node->size_extra;
}

/* ---- What there is ------------------------------------------------------------------------- */

/* The format of an index: modes of one format lie together. */
static uint32_t format_at(const replay_node *node, unsigned index)
{
    unsigned found = 0;

    for (unsigned i = 0; i < node->mode_count; i++) {
        if (i > 0 && node->modes[i].fourcc == node->modes[i - 1].fourcc) {
            continue;
        }
        if (found++ == index) {
            return node->modes[i].fourcc;
        }
    }
    return 0;
}

static int enum_format(const replay_node *node, struct v4l2_fmtdesc *entry)
{
    const uint32_t fourcc = format_at(node, node->endless ? 0 : entry->index);

    if (node->no_formats || entry->type != replay_queue_type(node) || fourcc == 0) {
        return replay_errno(EINVAL);
    }
    entry->pixelformat = fourcc;
    snprintf((char *)entry->description, sizeof entry->description, "Format %u", entry->index);
    return 0;
}

static int enum_size(const replay_node *node, struct v4l2_frmsizeenum *entry)
{
    unsigned index = node->endless ? 0 : entry->index;

    if (node->no_sizes) {
        return replay_errno(ENOTTY);
    }
    for (unsigned i = 0; i < node->mode_count; i++) {
        if (node->modes[i].fourcc != entry->pixel_format || index-- > 0) {
            continue;
        }
        if (node->stepwise) {
            entry->type = V4L2_FRMSIZE_TYPE_STEPWISE;
            entry->stepwise.min_width = node->modes[i].width;
            entry->stepwise.max_width = node->modes[i].width * 8;
            entry->stepwise.step_width = 6;
            entry->stepwise.min_height = node->modes[i].height;
            entry->stepwise.max_height = node->modes[i].height * 8;
            entry->stepwise.step_height = 4;
            return 0;
        }
        entry->type = V4L2_FRMSIZE_TYPE_DISCRETE;
        entry->discrete.width = node->modes[i].width;
        entry->discrete.height = node->modes[i].height;
        return 0;
    }
    return replay_errno(EINVAL);
}

static const replay_mode *mode_of(const replay_node *node, uint32_t fourcc, unsigned width,
                                  unsigned height)
{
    for (unsigned i = 0; i < node->mode_count; i++) {
        const replay_mode *const mode = &node->modes[i];

        if (mode->fourcc == fourcc &&
            (node->stepwise || (mode->width == width && mode->height == height))) {
            return mode;
        }
    }
    return NULL;
}

/* Two intervals: half the fastest rate first. */
static int enum_rate(const replay_node *node, struct v4l2_frmivalenum *entry)
{
    const replay_mode *const mode = mode_of(node, entry->pixel_format, entry->width, entry->height);

    if (node->no_rates || !mode || (entry->index > 1 && !node->endless)) {
        return replay_errno(node->no_rates ? ENOTTY : EINVAL);
    }
    entry->type = V4L2_FRMIVAL_TYPE_DISCRETE;
    entry->discrete.numerator = entry->index == 0 ? 2 : 1;
    entry->discrete.denominator = mode->rate;
    return 0;
}

/* ---- Setting and reading ------------------------------------------------------------------- */

/* The next step below, from `min` to eight times that. */
static unsigned step(unsigned asked, unsigned min, unsigned size)
{
    const unsigned most = 8 * min;
    const unsigned taken = asked < min ? min : (asked < most ? asked : most);

    return min + (taken - min) / size * size;
}

/* The mode that is nearest to what is asked for. */
static void choose(replay_node *node, uint32_t fourcc, unsigned width, unsigned height)
{
    const replay_mode *best = NULL;
    unsigned long nearest = 0;

    for (unsigned i = 0; i < node->mode_count; i++) {
        const replay_mode *const mode = &node->modes[i];
        const long across = (long)mode->width - (long)width;
        const long down = (long)mode->height - (long)height;
        const unsigned long apart = (unsigned long)(across * across + down * down) +
                                    (mode->fourcc == fourcc ? 0 : 1000000000);

        if (!best || apart < nearest) {
            best = mode;
            nearest = apart;
        }
    }
    if (!best) { /* a camera without modes */
        static const replay_mode none = {V4L2_PIX_FMT_YUYV, 8, 8, 1};

        best = &none;
    }
    node->fourcc = node->force_fourcc ? node->force_fourcc : best->fourcc;
    node->width = node->stepwise ? step(width, best->width, 6) : best->width;
    node->height = node->stepwise ? step(height, best->height, 4) : best->height;
    node->width = node->force_width ? node->force_width : node->width;
    node->height = node->force_height ? node->force_height : node->height;
    node->rate = best->rate;
    node->format_set = 1;
}

static void tell_format(const replay_node *node, struct v4l2_format *format)
{
    if (format->type == V4L2_BUF_TYPE_VIDEO_CAPTURE) {
        struct v4l2_pix_format *const pix = &format->fmt.pix;

        pix->pixelformat = node->fourcc;
        pix->width = node->width;
        pix->height = node->height;
        pix->field = node->field ? node->field : V4L2_FIELD_NONE;
        pix->bytesperline = node->no_stride ? 0 : replay_stride(node);
        pix->sizeimage = replay_frame_bytes(node);
        pix->colorspace = node->colorspace;
        pix->quantization = node->quantization;
        pix->priv = V4L2_PIX_FMT_PRIV_MAGIC;
    } else {
        struct v4l2_pix_format_mplane *const pix = &format->fmt.pix_mp;

        pix->pixelformat = node->fourcc;
        pix->width = node->width;
        pix->height = node->height;
        pix->field = node->field ? node->field : V4L2_FIELD_NONE;
        pix->num_planes = 1;
        pix->plane_fmt[0].bytesperline = node->no_stride ? 0 : replay_stride(node);
        pix->plane_fmt[0].sizeimage = replay_frame_bytes(node);
        pix->colorspace = node->colorspace;
        pix->quantization = (uint8_t)node->quantization;
    }
}

static int set_format(replay_node *node, struct v4l2_format *format)
{
    const struct v4l2_format asked = *format;

    if (format->type != replay_queue_type(node)) {
        return replay_errno(EINVAL);
    }
    if (node->buffer_count > 0) {
        return replay_errno(EBUSY);
    }
    if (format->type == V4L2_BUF_TYPE_VIDEO_CAPTURE) {
        choose(node, asked.fmt.pix.pixelformat, asked.fmt.pix.width, asked.fmt.pix.height);
    } else {
        choose(node, asked.fmt.pix_mp.pixelformat, asked.fmt.pix_mp.width, asked.fmt.pix_mp.height);
    }
    tell_format(node, format);
    if (node->format_lies && format->type == V4L2_BUF_TYPE_VIDEO_CAPTURE) {
        format->fmt.pix.pixelformat = asked.fmt.pix.pixelformat;
        format->fmt.pix.width = asked.fmt.pix.width;
        format->fmt.pix.height = asked.fmt.pix.height;
    }
    return 0;
}

static int get_format(replay_node *node, struct v4l2_format *format)
{
    if (node->no_get_format || format->type != replay_queue_type(node)) {
        return replay_errno(EINVAL);
    }
    if (!node->format_set) {
        choose(node, 0, 0, 0);
    }
    tell_format(node, format);
    return 0;
}

static int get_rate(const replay_node *node, struct v4l2_streamparm *parm)
{
    if (node->no_parm || parm->type != replay_queue_type(node)) {
        return replay_errno(node->no_parm ? ENOTTY : EINVAL);
    }
    parm->parm.capture.capability = V4L2_CAP_TIMEPERFRAME;
    parm->parm.capture.timeperframe.numerator = node->rate ? 1 : 0;
    parm->parm.capture.timeperframe.denominator = node->rate;
    return 0;
}

static int set_rate(replay_node *node, struct v4l2_streamparm *parm)
{
    const struct v4l2_fract asked = parm->parm.capture.timeperframe;
    const replay_mode *const mode = mode_of(node, node->fourcc, node->width, node->height);

    if (!node->rate_ignored && mode && asked.numerator > 0 && asked.denominator > 0) {
        const unsigned rate = asked.denominator / asked.numerator;

        node->rate = rate < 1 ? 1 : (rate < mode->rate ? rate : mode->rate);
    }
    return get_rate(node, parm);
}

static int tell_capability(const replay_node *node, struct v4l2_capability *out)
{
    memset(out, 0, sizeof *out);
    memcpy(out->driver, node->driver, strlen(node->driver));
    snprintf((char *)out->card, sizeof out->card, "%s", node->card);
    snprintf((char *)out->bus_info, sizeof out->bus_info, "%s", node->bus);
    out->device_caps = node->caps;
    out->capabilities = node->caps | V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_DEVICE_CAPS;
    return 0;
}

int replay_ioctl_format(replay *world, replay_node *node, unsigned long request, void *argument)
{
    (void)world;
    switch (request) {
    case VIDIOC_QUERYCAP:
        return tell_capability(node, (struct v4l2_capability *)argument);
    case VIDIOC_ENUM_FMT:
        return enum_format(node, (struct v4l2_fmtdesc *)argument);
    case VIDIOC_ENUM_FRAMESIZES:
        return enum_size(node, (struct v4l2_frmsizeenum *)argument);
    case VIDIOC_ENUM_FRAMEINTERVALS:
        return enum_rate(node, (struct v4l2_frmivalenum *)argument);
    case VIDIOC_S_FMT:
        return set_format(node, (struct v4l2_format *)argument);
    case VIDIOC_G_FMT:
        return get_format(node, (struct v4l2_format *)argument);
    case VIDIOC_S_PARM:
        return set_rate(node, (struct v4l2_streamparm *)argument);
    case VIDIOC_G_PARM:
        return get_rate(node, (struct v4l2_streamparm *)argument);
    default:
        return replay_errno(ENOTTY);
    }
}

/* ---- Controls ------------------------------------------------------------------------------ */

static replay_control *find_control(replay_node *node, uint32_t id)
{
    for (unsigned i = 0; i < node->control_count; i++) {
        if (node->controls[i].id == id) {
            return &node->controls[i];
        }
    }
    return NULL;
}

static int query_control(replay_node *node, struct v4l2_queryctrl *info)
{
    const uint32_t id = info->id & V4L2_CTRL_ID_MASK;
    const replay_control *found = NULL;

    if (info->id & V4L2_CTRL_FLAG_NEXT_CTRL) {
        for (unsigned i = 0; i < node->control_count && !node->no_next_control; i++) {
            const replay_control *const here = &node->controls[i];

            if (here->id > id && (!found || here->id < found->id)) {
                found = here;
            }
        }
    } else {
        found = find_control(node, id);
    }
    if (!found) {
        return replay_errno(EINVAL);
    }
    memset(info, 0, sizeof *info);
    info->id = found->id;
    info->type = found->type;
    info->flags = found->flags;
    memcpy(info->name, found->name, sizeof info->name);
    info->minimum = found->min;
    info->maximum = found->max;
    info->step = found->step;
    info->default_value = found->initial;
    return 0;
}

static int query_menu(replay_node *node, struct v4l2_querymenu *item)
{
    const replay_control *const control = find_control(node, item->id);

    if (!control || item->index >= 4 || !control->menu[item->index]) {
        return replay_errno(EINVAL);
    }
    snprintf((char *)item->name, sizeof item->name, "%s", control->menu[item->index]);
    return 0;
}

static int set_control(replay_node *node, struct v4l2_control *asked)
{
    replay_control *const control = find_control(node, asked->id);

    if (!control || control->error) {
        return replay_errno(control ? control->error : EINVAL);
    }
    if (!control->ignored) {
        control->value = asked->value - (asked->value - control->min) % control->step;
    }
    return 0;
}

int replay_ioctl_control(replay_node *node, unsigned long request, void *argument)
{
    struct v4l2_control *const value = (struct v4l2_control *)argument;
    const replay_control *control;

    switch (request) {
    case VIDIOC_QUERYCTRL:
        return query_control(node, (struct v4l2_queryctrl *)argument);
    case VIDIOC_QUERYMENU:
        return query_menu(node, (struct v4l2_querymenu *)argument);
    case VIDIOC_S_CTRL:
        return set_control(node, value);
    case VIDIOC_G_CTRL:
        control = find_control(node, value->id);
        if (!control) {
            return replay_errno(EINVAL);
        }
        value->value = control->value;
        return 0;
    default:
        return replay_errno(ENOTTY);
    }
}
