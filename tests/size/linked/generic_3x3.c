/* Any 3x3 kernel with any of the six borders, row by row: both are what the program's user says. */
#include <pel.h>

enum { WIDTH = 320, HEIGHT = 240 };

pel_kernel kernel;
pel_border border;
uint8_t line[WIDTH];
uint8_t last_line[WIDTH]; /* for PEL_BORDER_WRAP */

void start(void);

static uint8_t work[PEL_FILTER_BYTES_WRAP(WIDTH, 1)];

void start(void)
{
    const pel_filter_config config = {.kernel = &kernel,
                                      .width = WIDTH,
                                      .height = HEIGHT,
                                      .border = border,
                                      .last_rows = {last_line, NULL},
                                      .work = work,
                                      .work_bytes = sizeof work};
    pel_filter filter;
    for (;;) {
        (void)pel_filter_begin(&filter, &config);
        for (unsigned y = 0; y < HEIGHT; y++) {
            (void)pel_filter_push(&filter, line);
            while (pel_filter_pull(&filter, line) == PEL_OK) {
            }
        }
    }
}
