/* YUV4MPEG2 (mjpegtools): 4:2:0, 4:2:2 and mono of 8 bits, read and written. */
#ifndef Y4M_H
#define Y4M_H

#include "input.h"
#include "source.h"

/* What the stream header says. */
typedef struct y4m_stream {
    pel_format format; /* of the frames that y4m_read makes: I420, YUYV (for 4:2:2) or GRAY8 */
    pel_range range;   /* limited if the header does not say */
    unsigned width, height;
    unsigned long frames; /* read so far, for messages */
} y4m_stream;

int y4m_matches(const uint8_t *bytes, size_t count);

/* Reads the stream header. 0, or -1 after a message. */
int y4m_begin(input *in, y4m_stream *stream);

/* Reads the next frame; the bytes are those of the file in another order. 1 a frame, 0 the end, -1
 * after a message. */
int y4m_read(input *in, y4m_stream *stream, frame *picture);

/* What a stream header can say beside that. */
typedef struct y4m_notes {
    unsigned rate_num, rate_den; /* frames per second; 0: written as 30:1 */
    const char *comment;         /* becomes an XPEL= word, blanks as '_', lines ended by ';' */
} y4m_notes;

/* Writes the header and a frame; the view must be I420, YUYV or GRAY8. 0, or -1 if writing fails
 * (no message). `notes` may be NULL. */
int y4m_write_header(FILE *file, const pel_cview *view, const y4m_notes *notes);
int y4m_write_frame(FILE *file, const pel_cview *view);

#endif
