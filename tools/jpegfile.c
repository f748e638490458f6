#include "jpegfile.h"

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

#include <jerror.h>

#include "say.h"

/* libjpeg reports errors by longjmp: what must survive the jump lives here, in the caller's frame.
 * The library's managers come first, so that its pointers to them are pointers to these structs. */
typedef struct jpeg_errors {
    struct jpeg_error_mgr base;
    jmp_buf jump;
    char message[JMSG_LENGTH_MAX];
} jpeg_errors;

typedef struct jpeg_bytes {
    struct jpeg_source_mgr base;
    input *in;
    size_t window; /* bytes that were handed out and are not skipped in the input yet */
} jpeg_bytes;

typedef struct jpeg_reader {
    struct jpeg_decompress_struct jpeg;
    jpeg_errors errors;
    jpeg_bytes bytes;
    frame *picture;
    unsigned width, height;
    int gray;
} jpeg_reader;

int jpegfile_matches(const uint8_t *bytes, size_t count)
{
    return count >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

static void fail(j_common_ptr jpeg)
{
    jpeg_errors *errors = (jpeg_errors *)(void *)jpeg->err;

    jpeg->err->format_message(jpeg, errors->message);
    longjmp(errors->jump, 1);
}

static void fail_with(j_common_ptr jpeg, const char *words)
{
    jpeg_errors *errors = (jpeg_errors *)(void *)jpeg->err;

    snprintf(errors->message, sizeof errors->message, "%s", words);
    longjmp(errors->jump, 1);
}

/* Level -1 is damage, except for what cameras do every day and no pixel suffers from. */
static void judge_message(j_common_ptr jpeg, int level)
{
    int code = jpeg->err->msg_code;

    if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_ADOBE_XFORM &&
        code != JWRN_JFIF_MAJOR) {
        fail(jpeg);
    }
}

static void nothing_to_do(j_decompress_ptr jpeg)
{
    (void)jpeg;
}

static boolean next_window(j_decompress_ptr jpeg)
{
    jpeg_bytes *bytes = (jpeg_bytes *)(void *)jpeg->src;

    input_skip(bytes->in, bytes->window);
    bytes->base.next_input_byte = input_window(bytes->in, &bytes->window);
    bytes->base.bytes_in_buffer = bytes->window;
    if (bytes->window == 0) {
        fail_with((j_common_ptr)jpeg, "the file is cut short");
    }
    return TRUE;
}

static void skip_bytes(j_decompress_ptr jpeg, long count)
{
    struct jpeg_source_mgr *from = jpeg->src;
    size_t left = count > 0 ? (size_t)count : 0;

    while (left > from->bytes_in_buffer) {
        left -= from->bytes_in_buffer;
        next_window(jpeg);
    }
    from->next_input_byte += left;
    from->bytes_in_buffer -= left;
}

static void set_up(jpeg_reader *reader)
{
    struct jpeg_source_mgr *from = &reader->bytes.base;

    jpeg_create_decompress(&reader->jpeg);
    from->init_source = nothing_to_do;
    from->fill_input_buffer = next_window;
    from->skip_input_data = skip_bytes;
    from->resync_to_restart = jpeg_resync_to_restart;
    from->term_source = nothing_to_do;
    from->bytes_in_buffer = 0;
    from->next_input_byte = NULL;
    reader->jpeg.src = from;
}

static void read_header(jpeg_reader *reader)
{
    struct jpeg_decompress_struct *jpeg = &reader->jpeg;
    char words[100];

    jpeg_read_header(jpeg, TRUE);
    if (jpeg->image_width > PEL_SIDE_MAX || jpeg->image_height > PEL_SIDE_MAX) {
        snprintf(words, sizeof words, "a picture of %ux%u; each side must be 1 to %d",
                 jpeg->image_width, jpeg->image_height, PEL_SIDE_MAX);
        fail_with((j_common_ptr)jpeg, words);
    }
    if (jpeg->jpeg_color_space != JCS_GRAYSCALE && jpeg->jpeg_color_space != JCS_YCbCr &&
        jpeg->jpeg_color_space != JCS_RGB) {
        fail_with((j_common_ptr)jpeg,
                  "neither gray nor YCbCr nor RGB, but CMYK or unknown colours; "
                  "save it as an RGB picture");
    }
    reader->gray = jpeg->jpeg_color_space == JCS_GRAYSCALE;
    jpeg->out_color_space = reader->gray ? JCS_GRAYSCALE : JCS_RGB;
    jpeg->dct_method = JDCT_ISLOW;
}

static void read_rows(jpeg_reader *reader)
{
    struct jpeg_decompress_struct *jpeg = &reader->jpeg;
    size_t row_bytes;

    jpeg_start_decompress(jpeg);
    reader->width = jpeg->output_width;
    reader->height = jpeg->output_height;
    row_bytes = (size_t)jpeg->output_width * (reader->gray ? 1 : 3);
    while (jpeg->output_scanline < jpeg->output_height) {
        size_t y = jpeg->output_scanline;
        JSAMPROW row =
            frame_reserve(reader->picture, (y + 1) * row_bytes, row_bytes * reader->height);
        if (!row) {
            fail_with((j_common_ptr)jpeg, "not enough memory");
        }
        row += y * row_bytes;
        jpeg_read_scanlines(jpeg, &row, 1);
    }
    jpeg_finish_decompress(jpeg);
}

static int try_read(jpeg_reader *reader)
{
    reader->jpeg.err = jpeg_std_error(&reader->errors.base);
    reader->errors.base.error_exit = fail;
    reader->errors.base.emit_message = judge_message;
    if (setjmp(reader->errors.jump)) {
        return -1;
    }
    set_up(reader);
    read_header(reader);
    read_rows(reader);
    return 0;
}

int jpegfile_read(input *in, frame *picture)
{
    jpeg_reader reader = {0};
    int status;

    reader.bytes.in = in;
    reader.picture = picture;
    status = try_read(&reader);
    input_skip(in, reader.bytes.window - reader.bytes.base.bytes_in_buffer);
    jpeg_destroy_decompress(&reader.jpeg);
    if (status) {
        return input_error_byte(in, "JPEG: %s", reader.errors.message);
    }
    return frame_describe(picture, reader.gray ? PEL_GRAY8 : PEL_RGB888, PEL_RANGE_FULL,
                          reader.width, reader.height);
}

/* ---- Writing ------------------------------------------------------------------------------- */

typedef struct jpeg_writer {
    struct jpeg_compress_struct jpeg;
    jpeg_errors errors;
    uint8_t row[3 * PEL_SIDE_MAX];
} jpeg_writer;

static void set_picture(struct jpeg_compress_struct *jpeg, const pngfile_picture *picture)
{
    jpeg->image_width = picture->width;
    jpeg->image_height = picture->height;
    jpeg->input_components = picture->gray ? 1 : 3;
    jpeg->in_color_space = picture->gray ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(jpeg);
    jpeg_set_quality(jpeg, 95, TRUE);
    jpeg->comp_info[0].h_samp_factor = 1; /* as many samples of Y as of U and V */
    jpeg->comp_info[0].v_samp_factor = 1;
}

static void write_rows(jpeg_writer *writer, const pngfile_picture *picture)
{
    JSAMPROW row = writer->row;

    jpeg_start_compress(&writer->jpeg, TRUE);
    if (picture->comment) {
        jpeg_write_marker(&writer->jpeg, JPEG_COM, (const JOCTET *)picture->comment,
                          (unsigned)strlen(picture->comment));
    }
    for (unsigned y = 0; y < picture->height; y++) {
        picture->fill_row(picture->user, y, writer->row);
        jpeg_write_scanlines(&writer->jpeg, &row, 1);
    }
    jpeg_finish_compress(&writer->jpeg);
}

int jpegfile_write(FILE *file, const pngfile_picture *picture, char message[PNGFILE_MESSAGE_BYTES])
{
    jpeg_writer *const writer = calloc(1, sizeof *writer);

    if (!writer) {
        snprintf(message, PNGFILE_MESSAGE_BYTES, "not enough memory");
        return -1;
    }
    writer->jpeg.err = jpeg_std_error(&writer->errors.base);
    writer->errors.base.error_exit = fail;
    if (setjmp(writer->errors.jump)) {
        snprintf(message, PNGFILE_MESSAGE_BYTES, "%s", writer->errors.message);
        jpeg_destroy_compress(&writer->jpeg);
        free(writer);
        return -1;
    }
    jpeg_create_compress(&writer->jpeg);
    jpeg_stdio_dest(&writer->jpeg, file);
    set_picture(&writer->jpeg, picture);
    write_rows(writer, picture);
    jpeg_destroy_compress(&writer->jpeg);
    free(writer);
    return 0;
}
