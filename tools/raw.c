#include "raw.h"

#include "say.h"

int raw_read(input *in, const source_options *options, unsigned long number, frame *picture)
{
    size_t total =
        pel_frame_bytes(options->format, (uint16_t)options->width, (uint16_t)options->height);
    size_t done = 0;

    if (input_at_end(in) && !in->read_errno) {
        return 0;
    }
    while (done < total) {
        size_t piece = total - done < INPUT_BUFFER_BYTES ? total - done : INPUT_BUFFER_BYTES;
        uint8_t *bytes = frame_reserve(picture, done + piece, total);
        if (!bytes) {
            return say_error(in->path, "not enough memory for a frame of %zu bytes", total);
        }
        piece = input_read(in, bytes + done, piece);
        if (piece == 0) {
            return input_error_byte(in,
                                    "frame %lu is cut short: %s frames of %ux%u take %zu bytes, "
                                    "it has %zu; is --raw right?",
                                    number, pel_format_name(options->format), options->width,
                                    options->height, total, done);
        }
        done += piece;
    }
    return frame_describe(picture, options->format, options->range, options->width, options->height)
               ? -1
               : 1;
}

/* Chroma planes have half the rows: of U V pairs as long as the Y row, or of U or V alone. */
void raw_each_row(const pel_cview *view, raw_take_row *take, void *user)
{
    size_t row_bytes = pel_row_bytes(view->format, view->width);
    size_t left = pel_frame_bytes(view->format, view->width, view->height);
    size_t rows = view->height, y;
    int plane;

    for (plane = 0; plane < 3 && left > 0; plane++) {
        for (y = 0; y < rows; y++) {
            take(user, view->plane[plane] + (ptrdiff_t)y * view->stride_bytes[plane], row_bytes);
        }
        left -= rows * row_bytes;
        if (plane == 0 && left > 0) {
            rows /= 2;
            row_bytes = view->format == PEL_I420 ? row_bytes / 2 : row_bytes;
        }
    }
}

static void write_row(void *user, const uint8_t *bytes, size_t count)
{
    fwrite(bytes, 1, count, user);
}

int raw_write(FILE *file, const pel_cview *view)
{
    raw_each_row(view, write_row, file);
    return ferror(file) ? -1 : 0;
}
