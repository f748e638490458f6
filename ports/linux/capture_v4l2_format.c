/* Setting format, size and rate; only what was read back goes into the settings. */
#include "v4l2_camera.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* The parts of v4l2_format that matter here, of either kind of queue. */
typedef struct picture {
    uint32_t fourcc;
    uint32_t width, height;
    uint32_t stride, bytes;
    uint32_t field;
    int full_range;
    unsigned planes;
} picture;

static void read_single(const struct v4l2_pix_format *pix, picture *out)
{
    const int extended = pix->priv == V4L2_PIX_FMT_PRIV_MAGIC; /* else quantization is not set */
    const uint32_t said = extended ? pix->quantization : V4L2_QUANTIZATION_DEFAULT;

    out->fourcc = pix->pixelformat;
    out->width = pix->width;
    out->height = pix->height;
    out->stride = pix->bytesperline;
    out->bytes = pix->sizeimage;
    out->field = pix->field;
    out->planes = 1;
    out->full_range = said == V4L2_QUANTIZATION_DEFAULT ? pix->colorspace == V4L2_COLORSPACE_JPEG
                                                        : said == V4L2_QUANTIZATION_FULL_RANGE;
}

static void read_multi(const struct v4l2_pix_format_mplane *pix, picture *out)
{
    const uint32_t said = pix->quantization;

    out->fourcc = pix->pixelformat;
    out->width = pix->width;
    out->height = pix->height;
    out->stride = pix->plane_fmt[0].bytesperline;
    out->bytes = pix->plane_fmt[0].sizeimage;
    out->field = pix->field;
    out->planes = pix->num_planes;
    out->full_range = said == V4L2_QUANTIZATION_DEFAULT ? pix->colorspace == V4L2_COLORSPACE_JPEG
                                                        : said == V4L2_QUANTIZATION_FULL_RANGE;
}

static void read_picture(const v4l2_device *device, const struct v4l2_format *format, picture *out)
{
    memset(out, 0, sizeof *out);
    if (device->queue == V4L2_BUF_TYPE_VIDEO_CAPTURE) {
        read_single(&format->fmt.pix, out);
    } else {
        read_multi(&format->fmt.pix_mp, out);
    }
}

static int get_picture(v4l2_device *device, picture *out)
{
    struct v4l2_format format;

    memset(&format, 0, sizeof format);
    format.type = device->queue;
    if (v4l2_call(device, VIDIOC_G_FMT, &format)) {
        return -1;
    }
    read_picture(device, &format, out);
    return 0;
}

/* Asks for a picture and reads what became of it. */
static int set_picture(v4l2_device *device, uint32_t fourcc, unsigned width, unsigned height,
                       picture *out)
{
    struct v4l2_format format;

    memset(&format, 0, sizeof format);
    format.type = device->queue;
    if (device->queue == V4L2_BUF_TYPE_VIDEO_CAPTURE) {
        format.fmt.pix.pixelformat = fourcc;
        format.fmt.pix.width = width;
        format.fmt.pix.height = height;
        format.fmt.pix.field = V4L2_FIELD_NONE;
        format.fmt.pix.priv = V4L2_PIX_FMT_PRIV_MAGIC;
    } else {
        format.fmt.pix_mp.pixelformat = fourcc;
        format.fmt.pix_mp.width = width;
        format.fmt.pix_mp.height = height;
        format.fmt.pix_mp.field = V4L2_FIELD_NONE;
        format.fmt.pix_mp.num_planes = 1;
    }
    if (v4l2_call(device, VIDIOC_S_FMT, &format)) {
        return -1;
    }
    read_picture(device, &format, out);
    /* What holds is what the driver says when it is asked again, if it can be. */
    return get_picture(device, out) == 0 || errno == EINVAL || errno == ENOTTY ? 0 : -1;
}

/* ---- From what the driver says to settings ------------------------------------------------- */

/*
 * How many bytes a frame has at least: up to the last pixel of the last row. Chroma planes behind
 * the first make it longer in the ratio in which they make a frame without padding longer.
 */
static uint64_t bytes_needed(pel_format format, const picture *pic, uint32_t stride)
{
    const uint32_t row = pel_row_bytes(format, (uint16_t)pic->width);
    const uint64_t packed = (uint64_t)row * pic->height;
    const uint64_t frame = pel_frame_bytes(format, (uint16_t)pic->width, (uint16_t)pic->height);
    const uint64_t all = (uint64_t)stride * pic->height * frame / packed;

    return all - (frame > packed ? (stride - row) / 2 : stride - row);
}

/* Half-height fields one below the other are no picture. */
static int is_readable_field(uint32_t field)
{
    return field != V4L2_FIELD_SEQ_TB && field != V4L2_FIELD_SEQ_BT;
}

static int find_stride(pel_format format, const picture *pic, uint32_t *stride)
{
    const uint32_t row = pel_row_bytes(format, (uint16_t)pic->width);
    pel_cview view;
    uint8_t byte;

    *stride = pic->stride ? pic->stride : row;
    /* The pointer is only checked for not being null. */
    return *stride <= INT32_MAX &&
           pel_cview_init(&byte, format, PEL_RANGE_FULL, (uint16_t)pic->width,
                          (uint16_t)pic->height, (int32_t)*stride, &view) == PEL_OK;
}

/* Takes a picture into the settings; 0 if frames of it cannot be read. */
static int take_picture(capture *camera, const picture *pic)
{
    capture_settings *const settings = &camera->settings;
    pel_format format;
    const int kind = capture_format_of(pic->fourcc, &format);
    uint32_t stride = 0;
    uint64_t needed = 4; /* of a JPEG: its first and last mark */

    if (kind == 0 || pic->planes != 1 || !is_readable_field(pic->field) || pic->width == 0 ||
        pic->height == 0 || pic->width > PEL_SIDE_MAX || pic->height > PEL_SIDE_MAX) {
        return 0;
    }
    if (kind == 1) {
        if (!find_stride(format, pic, &stride)) {
            return 0;
        }
        needed = bytes_needed(format, pic, stride);
    }
    if (needed > UINT32_MAX) {
        return 0;
    }
    settings->fourcc = pic->fourcc;
    settings->format = format;
    settings->compressed = kind == 2;
    settings->range = capture_format_has_range(pic->fourcc) && !pic->full_range ? PEL_RANGE_LIMITED
                                                                                : PEL_RANGE_FULL;
    settings->width = pic->width;
    settings->height = pic->height;
    settings->bytes_per_line = stride;
    settings->frame_bytes = pic->bytes > needed ? pic->bytes : (uint32_t)needed;
    v4l2_state(camera)->needed = (size_t)needed;
    return 1;
}

/* ---- Negotiation --------------------------------------------------------------------------- */

static capture_status try_candidates(capture *camera)
{
    v4l2_device *const device = &v4l2_state(camera)->device;
    v4l2_candidate candidates[V4L2_CANDIDATES_MAX];
    const unsigned count = v4l2_candidates(camera, candidates);
    int error = 0;

    for (unsigned i = 0; i < count; i++) {
        picture pic;

        if (set_picture(device, candidates[i].fourcc, candidates[i].width, candidates[i].height,
                        &pic) == 0) {
            if (take_picture(camera, &pic)) {
                return CAPTURE_OK;
            }
            continue;
        }
        error = errno;
        if (v4l2_status_of(error) != CAPTURE_ERR_SYSTEM) { /* the others would end so, too */
            break;
        }
    }
    if (error) {
        return v4l2_fail(camera, "VIDIOC_S_FMT", error);
    }
    return capture_fail(camera, CAPTURE_ERR_FORMAT, "%.200s: none of its formats can be read here",
                        device->path);
}

static void note_format(capture *camera)
{
    const capture_wish *const wish = &camera->wish;
    const capture_settings *const settings = &camera->settings;
    char asked[16];
    char got[16];

    if (wish->fourcc && wish->fourcc != settings->fourcc) {
        capture_fourcc_text(wish->fourcc, asked);
        capture_fourcc_text(settings->fourcc, got);
        capture_note_change(camera, "format %s became %s", asked, got);
    }
    if ((wish->width && wish->width != settings->width) ||
        (wish->height && wish->height != settings->height)) {
        capture_note_change(camera, "size %ux%u became %ux%u", wish->width, wish->height,
                            settings->width, settings->height);
    }
}

static void rate_text(unsigned num, unsigned den, char text[24])
{
    if (den == 0) {
        snprintf(text, 24, "unknown");
    } else if (num % den == 0) {
        snprintf(text, 24, "%u", num / den);
    } else {
        const uint64_t hundredths = ((uint64_t)num * 100 + den / 2) / den;

        snprintf(text, 24, "%lu.%02u", (unsigned long)(hundredths / 100),
                 (unsigned)(hundredths % 100));
    }
}

static void note_rate(capture *camera)
{
    const capture_wish *const wish = &camera->wish;
    const capture_settings *const settings = &camera->settings;
    const uint64_t asked = (uint64_t)wish->rate_num * settings->rate_den;
    const uint64_t got = (uint64_t)settings->rate_num * wish->rate_den;
    const uint64_t apart = asked > got ? asked - got : got - asked;
    char asked_text[24];
    char got_text[24];

    /* Intervals come in ticks of 100 ns and such: half a thousandth is the same rate. */
    if (wish->rate_num == 0 || (settings->rate_den != 0 && apart <= asked / 2000)) {
        return;
    }
    rate_text(wish->rate_num, wish->rate_den, asked_text);
    rate_text(settings->rate_num, settings->rate_den, got_text);
    capture_note_change(camera, "rate %s became %s", asked_text, got_text);
}

static void read_rate_back(capture *camera)
{
    v4l2_device *const device = &v4l2_state(camera)->device;
    capture_settings *const settings = &camera->settings;
    struct v4l2_streamparm parm;

    settings->rate_num = settings->rate_den = 0;
    memset(&parm, 0, sizeof parm);
    parm.type = device->queue;
    if (v4l2_call(device, VIDIOC_G_PARM, &parm) == 0 &&
        parm.parm.capture.timeperframe.numerator > 0 &&
        parm.parm.capture.timeperframe.denominator > 0) {
        settings->rate_num = parm.parm.capture.timeperframe.denominator;
        settings->rate_den = parm.parm.capture.timeperframe.numerator;
    }
}

/* A driver that cannot set a rate is no failure: the read-back tells. */
void v4l2_set_rate(capture *camera)
{
    v4l2_device *const device = &v4l2_state(camera)->device;
    struct v4l2_streamparm parm;

    if (camera->wish.rate_num > 0) {
        memset(&parm, 0, sizeof parm);
        parm.type = device->queue;
        parm.parm.capture.timeperframe.numerator = camera->wish.rate_den;
        parm.parm.capture.timeperframe.denominator = camera->wish.rate_num;
        v4l2_call(device, VIDIOC_S_PARM, &parm);
    }
    read_rate_back(camera);
}

capture_status v4l2_negotiate(capture *camera)
{
    const capture_status status = try_candidates(camera);

    if (status != CAPTURE_OK) {
        return status;
    }
    v4l2_set_rate(camera);
    note_format(camera);
    note_rate(camera);
    return camera->changes[0] ? CAPTURE_CHANGED : CAPTURE_OK;
}

static int is_same(const capture_settings *settings, const picture *pic)
{
    return pic->fourcc == settings->fourcc && pic->width == settings->width &&
           pic->height == settings->height;
}

capture_status v4l2_confirm_format(capture *camera)
{
    v4l2_device *const device = &v4l2_state(camera)->device;
    const capture_settings was = camera->settings;
    picture pic;

    if (get_picture(device, &pic) || !is_same(&was, &pic)) {
        if (set_picture(device, was.fourcc, was.width, was.height, &pic)) {
            return v4l2_fail(camera, "VIDIOC_S_FMT", errno);
        }
    }
    if (!is_same(&was, &pic) || !take_picture(camera, &pic)) {
        camera->settings = was;
        return capture_fail(camera, CAPTURE_ERR_FORMAT,
                            "%.200s: its format was changed and cannot be set again", device->path);
    }
    return CAPTURE_OK;
}
