#include "pngfile.h"

#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "say.h"

/*
 * libpng reports errors by longjmp. What must survive the jump lives in these structs, in the
 * caller's frame, and the functions that call setjmp have no local variables that change after it.
 */
typedef struct png_reader {
    input *in;
    frame *picture;
    png_structp png;
    png_infop info;
    png_bytep *rows; /* of an interlaced picture */
    png_uint_32 width, height;
    int color_type;
    char message[PNGFILE_MESSAGE_BYTES];
} png_reader;

int pngfile_matches(const uint8_t *bytes, size_t count)
{
    return count >= 4 && memcmp(bytes, "\x89PNG", 4) == 0;
}

/* `user` is a message buffer. */
static void keep_message(png_structp png, png_const_charp words)
{
    char *message = png_get_error_ptr(png);

    snprintf(message, PNGFILE_MESSAGE_BYTES, "%s", words);
    longjmp(png_jmpbuf(png), 1);
}

/* Warnings are about chunks that do not touch the pixels. */
static void ignore_warning(png_structp png, png_const_charp words)
{
    (void)png;
    (void)words;
}

static void take_bytes(png_structp png, png_bytep bytes, size_t count)
{
    if (input_read(png_get_io_ptr(png), bytes, count) != count) {
        png_error(png, "the file is cut short");
    }
}

/* Asks libpng for 8-bit gray or RGB without alpha, whatever is in the file. */
static void set_transforms(const png_reader *reader)
{
    png_structp png = reader->png;
    int gray = reader->color_type == PNG_COLOR_TYPE_GRAY;

    if (png_get_bit_depth(png, reader->info) == 16) {
        png_set_scale_16(png);
    }
    if (gray && png_get_bit_depth(png, reader->info) < 8) {
        png_set_expand_gray_1_2_4_to_8(png);
    }
    if (reader->color_type == PNG_COLOR_TYPE_PALETTE) {
        png_set_palette_to_rgb(png);
    }
    png_set_strip_alpha(png);
}

static void check_size(const png_reader *reader)
{
    char words[100];

    if (reader->width > PEL_SIDE_MAX || reader->height > PEL_SIDE_MAX) {
        snprintf(words, sizeof words, "a picture of %lux%lu; each side must be 1 to %d",
                 (unsigned long)reader->width, (unsigned long)reader->height, PEL_SIDE_MAX);
        png_error(reader->png, words);
    }
}

static void reserve(const png_reader *reader, size_t bytes, size_t total)
{
    if (!frame_reserve(reader->picture, bytes, total)) {
        png_error(reader->png, "not enough memory");
    }
}

static void read_rows(const png_reader *reader, size_t row_bytes)
{
    size_t y;

    for (y = 0; y < reader->height; y++) {
        reserve(reader, (y + 1) * row_bytes, row_bytes * reader->height);
        png_read_row(reader->png, reader->picture->bytes + y * row_bytes, NULL);
    }
}

/* Every pass touches all rows. */
static void read_interlaced(png_reader *reader, size_t row_bytes)
{
    size_t y;

    reserve(reader, row_bytes * reader->height, row_bytes * reader->height);
    reader->rows = malloc(reader->height * sizeof *reader->rows);
    if (!reader->rows) {
        png_error(reader->png, "not enough memory");
    }
    for (y = 0; y < reader->height; y++) {
        reader->rows[y] = reader->picture->bytes + y * row_bytes;
    }
    png_read_image(reader->png, reader->rows);
}

static void read_pixels(png_reader *reader)
{
    int passes;

    png_read_info(reader->png, reader->info);
    reader->width = png_get_image_width(reader->png, reader->info);
    reader->height = png_get_image_height(reader->png, reader->info);
    reader->color_type = png_get_color_type(reader->png, reader->info);
    check_size(reader);
    set_transforms(reader);
    passes = png_set_interlace_handling(reader->png);
    png_read_update_info(reader->png, reader->info);
    if (passes > 1) {
        read_interlaced(reader, png_get_rowbytes(reader->png, reader->info));
    } else {
        read_rows(reader, png_get_rowbytes(reader->png, reader->info));
    }
    png_read_end(reader->png, NULL);
}

static int try_read(png_reader *reader)
{
    reader->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, reader->message, keep_message,
                                         ignore_warning);
    if (!reader->png || !(reader->info = png_create_info_struct(reader->png))) {
        snprintf(reader->message, sizeof reader->message, "not enough memory");
        return -1;
    }
    if (setjmp(png_jmpbuf(reader->png))) {
        return -1;
    }
    png_set_read_fn(reader->png, reader->in, take_bytes);
    png_set_user_limits(reader->png, PNG_UINT_31_MAX, PNG_UINT_31_MAX); /* ours has better words */
    read_pixels(reader);
    return 0;
}

int pngfile_read(input *in, frame *picture)
{
    png_reader reader = {0};
    int status, gray;

    reader.in = in;
    reader.picture = picture;
    status = try_read(&reader);
    png_destroy_read_struct(&reader.png, &reader.info, NULL);
    free(reader.rows);
    if (status) {
        return input_error_byte(in, "PNG: %s", reader.message);
    }
    gray = (reader.color_type & PNG_COLOR_MASK_COLOR) == 0;
    return frame_describe(picture, gray ? PEL_GRAY8 : PEL_RGB888, PEL_RANGE_FULL,
                          (unsigned)reader.width, (unsigned)reader.height);
}

typedef struct png_writer {
    FILE *file;
    const pngfile_picture *picture;
    png_structp png;
    png_infop info;
    uint8_t row[3 * PEL_SIDE_MAX];
} png_writer;

static void put_bytes(png_structp png, png_bytep bytes, size_t count)
{
    if (fwrite(bytes, 1, count, png_get_io_ptr(png)) != count) {
        png_error(png, "cannot write");
    }
}

/* Flushing is left to whoever closes the file. */
static void put_nothing(png_structp png)
{
    (void)png;
}

static void set_comment(const png_writer *writer, char *comment)
{
    png_text text;
    char keyword[] = "Comment";

    memset(&text, 0, sizeof text);
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = keyword;
    text.text = comment;
    png_set_text(writer->png, writer->info, &text, 1);
}

static void write_pixels(png_writer *writer)
{
    const pngfile_picture *picture = writer->picture;
    unsigned y;

    png_write_info(writer->png, writer->info);
    for (y = 0; y < picture->height; y++) {
        picture->fill_row(picture->user, y, writer->row);
        png_write_row(writer->png, writer->row);
    }
    png_write_end(writer->png, NULL);
}

static int try_write(png_writer *writer, char *comment, char *message)
{
    const pngfile_picture *picture = writer->picture;

    writer->png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, message, keep_message, ignore_warning);
    if (!writer->png || !(writer->info = png_create_info_struct(writer->png))) {
        snprintf(message, PNGFILE_MESSAGE_BYTES, "not enough memory");
        return -1;
    }
    if (setjmp(png_jmpbuf(writer->png))) {
        return -1;
    }
    png_set_write_fn(writer->png, writer->file, put_bytes, put_nothing);
    png_set_IHDR(writer->png, writer->info, picture->width, picture->height, 8,
                 picture->gray ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (comment) {
        set_comment(writer, comment);
    }
    write_pixels(writer);
    return 0;
}

int pngfile_write(FILE *file, const pngfile_picture *picture, char message[PNGFILE_MESSAGE_BYTES])
{
    png_writer writer = {0};
    char *comment = NULL;
    int status;

    if (picture->comment) {
        size_t bytes = strlen(picture->comment) + 1;
        comment = malloc(bytes); /* libpng wants to write to it, or says so */
        if (!comment) {
            snprintf(message, PNGFILE_MESSAGE_BYTES, "not enough memory");
            return -1;
        }
        memcpy(comment, picture->comment, bytes);
    }
    writer.file = file;
    writer.picture = picture;
    status = try_write(&writer, comment, message);
    png_destroy_write_struct(&writer.png, &writer.info);
    free(comment);
    return status;
}
