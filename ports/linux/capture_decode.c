/* JPEG frames by libjpeg (libjpeg-turbo), where there is one. */
#include "backend.h"

static capture_status check_call(capture *camera, const capture_frame *frame, const pel_view *rgb)
{
    pel_cview view;

    if (!camera->settings.compressed || !frame->bytes) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "this frame is not compressed");
    }
    if (!rgb->plane[0]) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "no memory to decode into");
    }
    view = pel_view_to_read(rgb);
    if (rgb->format != PEL_RGB888 || pel_cview_check(&view) != PEL_OK) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "frames are decoded into an RGB888 view");
    }
    if (rgb->width != camera->settings.width || rgb->height != camera->settings.height) {
        return capture_fail(camera, CAPTURE_ERR_ARG, "the view is %ux%u, the frame %ux%u",
                            rgb->width, rgb->height, camera->settings.width,
                            camera->settings.height);
    }
    return CAPTURE_OK;
}

#ifdef CAPTURE_HAVE_JPEG

#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#include <jpeglib.h>

#include <jerror.h>

/* What must survive libjpeg's longjmp lives in the caller's frame. The managers come first, so that
 * the library's pointers to them are pointers to this struct's parts. */
typedef struct jpeg_errors {
    struct jpeg_error_mgr base;
    jmp_buf jump;
    char message[JMSG_LENGTH_MAX];
} jpeg_errors;

typedef struct jpeg_decoder {
    struct jpeg_decompress_struct jpeg;
    struct jpeg_source_mgr source;
    jpeg_errors errors;
} jpeg_decoder;

static void leave(j_common_ptr jpeg)
{
    jpeg_errors *const errors = (jpeg_errors *)(void *)jpeg->err;

    jpeg->err->format_message(jpeg, errors->message);
    longjmp(errors->jump, 1);
}

/* Level -1 is damage, except for what cameras do every day and no pixel suffers from. */
static void judge_message(j_common_ptr jpeg, int level)
{
    const int code = jpeg->err->msg_code;

    if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_ADOBE_XFORM &&
        code != JWRN_JFIF_MAJOR && code != JWRN_JPEG_EOF) {
        leave(jpeg);
    }
}

static void nothing_to_do(j_decompress_ptr jpeg)
{
    (void)jpeg;
}

/* A frame that ends early is given an end-of-image mark: many cameras leave it out, and if pixels
 * are missing, too, the decoder says so when it meets the mark. */
static boolean end_of_bytes(j_decompress_ptr jpeg)
{
    static const JOCTET end[2] = {0xFF, JPEG_EOI};

    jpeg->src->next_input_byte = end;
    jpeg->src->bytes_in_buffer = sizeof end;
    return TRUE;
}

static void skip_bytes(j_decompress_ptr jpeg, long count)
{
    struct jpeg_source_mgr *const from = jpeg->src;
    const size_t wanted = count > 0 ? (size_t)count : 0;
    const size_t there = wanted < from->bytes_in_buffer ? wanted : from->bytes_in_buffer;

    from->next_input_byte += there;
    from->bytes_in_buffer -= there;
    if (there < wanted) {
        end_of_bytes(jpeg);
    }
}

static void set_up(jpeg_decoder *decoder, const capture_frame *frame)
{
    jpeg_create_decompress(&decoder->jpeg);
    decoder->source.init_source = nothing_to_do;
    decoder->source.fill_input_buffer = end_of_bytes;
    decoder->source.skip_input_data = skip_bytes;
    decoder->source.resync_to_restart = jpeg_resync_to_restart;
    decoder->source.term_source = nothing_to_do;
    decoder->source.next_input_byte = frame->bytes;
    decoder->source.bytes_in_buffer = frame->byte_count;
    decoder->jpeg.src = &decoder->source;
}

static void read_rows(jpeg_decoder *decoder, const pel_view *rgb)
{
    struct jpeg_decompress_struct *const jpeg = &decoder->jpeg;

    while (jpeg->output_scanline < jpeg->output_height) {
        JSAMPROW row =
            rgb->plane[0] + (ptrdiff_t)jpeg->output_scanline * (ptrdiff_t)rgb->stride_bytes[0];

        jpeg_read_scanlines(jpeg, &row, 1);
    }
}

static int try_decode(jpeg_decoder *decoder, const capture_frame *frame, const pel_view *rgb)
{
    struct jpeg_decompress_struct *const jpeg = &decoder->jpeg;

    jpeg->err = jpeg_std_error(&decoder->errors.base);
    decoder->errors.base.error_exit = leave;
    decoder->errors.base.emit_message = judge_message;
    if (setjmp(decoder->errors.jump)) {
        return -1;
    }
    set_up(decoder, frame);
    jpeg_read_header(jpeg, TRUE);
    if (jpeg->image_width != rgb->width || jpeg->image_height != rgb->height) {
        snprintf(decoder->errors.message, sizeof decoder->errors.message,
                 "it is %ux%u and not %ux%u", jpeg->image_width, jpeg->image_height, rgb->width,
                 rgb->height);
        return -1;
    }
    jpeg->out_color_space = JCS_RGB;
    jpeg->dct_method = JDCT_ISLOW;
    jpeg_start_decompress(jpeg);
    read_rows(decoder, rgb);
    return 0;
}

int capture_can_decode(void)
{
    return 1;
}

static capture_status decode(capture *camera, const capture_frame *frame, const pel_view *rgb)
{
    jpeg_decoder decoder;
    int status;

    memset(&decoder, 0, sizeof decoder);
    status = try_decode(&decoder, frame, rgb);
    jpeg_destroy_decompress(&decoder.jpeg);
    if (status) {
        return capture_fail(camera, CAPTURE_ERR_FORMAT, "damaged JPEG: %s", decoder.errors.message);
    }
    return CAPTURE_OK;
}

#else

int capture_can_decode(void)
{
    return 0;
}

static capture_status decode(capture *camera, const capture_frame *frame, const pel_view *rgb)
{
    (void)frame;
    (void)rgb;
    return capture_fail(camera, CAPTURE_ERR_FORMAT, "JPEG frames: this build has no libjpeg");
}

#endif

capture_status capture_decode(capture *camera, const capture_frame *frame, const pel_view *rgb)
{
    capture_status status;

    if (!camera || !frame || !rgb) {
        return CAPTURE_ERR_ARG;
    }
    camera->error[0] = '\0';
    status = check_call(camera, frame, rgb);
    return status == CAPTURE_OK ? decode(camera, frame, rgb) : status;
}
