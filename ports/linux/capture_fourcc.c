/* V4L2's codes of pixel formats: which pel reads, and as text. */
#include "backend.h"

#include <stdio.h>
#include <string.h>
#include <sys/time.h>

#include <linux/videodev2.h>

typedef struct code_format {
    uint32_t fourcc;
    pel_format format;
    int compressed;
    int has_range;
} code_format;

/* Best first: all colours at half the chroma, then less chroma, then what costs a conversion, then
 * what loses resolution or all colour. */
static const code_format code_formats[] = {
    {V4L2_PIX_FMT_YUYV, PEL_YUYV, 0, 1},          {V4L2_PIX_FMT_UYVY, PEL_UYVY, 0, 1},
    {V4L2_PIX_FMT_YVYU, PEL_YVYU, 0, 1},          {V4L2_PIX_FMT_VYUY, PEL_VYUY, 0, 1},
    {V4L2_PIX_FMT_NV12, PEL_NV12, 0, 1},          {V4L2_PIX_FMT_YUV420, PEL_I420, 0, 1},
    {V4L2_PIX_FMT_RGB24, PEL_RGB888, 0, 0},       {V4L2_PIX_FMT_BGR24, PEL_BGR888, 0, 0},
    {V4L2_PIX_FMT_RGB565, PEL_RGB565_LE, 0, 0},   {V4L2_PIX_FMT_RGB565X, PEL_RGB565_BE, 0, 0},
    {V4L2_PIX_FMT_MJPEG, PEL_RGB888, 1, 0},       {V4L2_PIX_FMT_JPEG, PEL_RGB888, 1, 0},
    {V4L2_PIX_FMT_SRGGB8, PEL_BAYER8_RGGB, 0, 0}, {V4L2_PIX_FMT_SGRBG8, PEL_BAYER8_GRBG, 0, 0},
    {V4L2_PIX_FMT_SGBRG8, PEL_BAYER8_GBRG, 0, 0}, {V4L2_PIX_FMT_SBGGR8, PEL_BAYER8_BGGR, 0, 0},
    {V4L2_PIX_FMT_GREY, PEL_GRAY8, 0, 1},
};

int capture_format_rank(uint32_t fourcc)
{
    for (size_t i = 0; i < sizeof code_formats / sizeof code_formats[0]; i++) {
        if (code_formats[i].fourcc == fourcc) {
            return (int)i;
        }
    }
    return -1;
}

uint32_t capture_format_at(int rank)
{
    const int count = (int)(sizeof code_formats / sizeof code_formats[0]);

    return rank >= 0 && rank < count ? code_formats[rank].fourcc : 0;
}

int capture_format_has_range(uint32_t fourcc)
{
    const int rank = capture_format_rank(fourcc);

    return rank >= 0 && code_formats[rank].has_range;
}

int capture_format_of(uint32_t fourcc, pel_format *format)
{
    const int rank = capture_format_rank(fourcc);

    if (rank < 0) {
        return 0;
    }
    if (format) {
        *format = code_formats[rank].format;
    }
    return code_formats[rank].compressed ? 2 : 1;
}

void capture_fourcc_text(uint32_t fourcc, char text[16])
{
    unsigned used = 4;

    for (unsigned i = 0; i < 4; i++) {
        const uint32_t byte = fourcc >> (8 * i) & 0xFF;

        if (byte < 0x20 || byte > 0x7E) {
            snprintf(text, 16, "0x%08lX", (unsigned long)fourcc);
            return;
        }
        text[i] = (char)byte;
    }
    while (used > 1 && text[used - 1] == ' ') { /* "Y16 " */
        used--;
    }
    text[used] = '\0';
}

uint32_t capture_fourcc(const char *text)
{
    uint32_t fourcc = 0;
    size_t length;

    if (!text) {
        return 0;
    }
    length = strlen(text);
    if (length < 1 || length > 4) {
        return 0;
    }
    for (size_t i = 0; i < 4; i++) {
        const unsigned char byte = i < length ? (unsigned char)text[i] : ' ';

        if (byte < 0x20 || byte > 0x7E) {
            return 0;
        }
        fourcc |= (uint32_t)byte << (8 * i);
    }
    return fourcc;
}
