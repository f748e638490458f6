#include "benchring.h"

#include <stdlib.h>
#include <string.h>

#include "say.h"

/* Cameras hand over whole pages; this keeps all copies alike as well. */
enum { PAGE = 4096 };

static size_t bytes_of(const bench_picture *picture, unsigned form)
{
    const pel_view *view = &picture->form[form].view;
    return pel_frame_bytes(view->format, view->width, view->height);
}

/* The same in whole pages. */
static size_t room_of(const bench_picture *picture, unsigned form)
{
    return (bytes_of(picture, form) + PAGE - 1) / PAGE * PAGE;
}

static size_t room_of_all(const bench_picture *picture)
{
    size_t room = 0;
    for (unsigned form = 0; form < BENCH_FORMS; form++) {
        room += room_of(picture, form);
    }
    return room;
}

unsigned benchring_count(const bench_picture *picture, unsigned wanted)
{
    const size_t most = ((size_t)BENCH_RING_MIB << 20) / room_of_all(picture);
    return wanted <= most ? wanted : most > 1 ? (unsigned)most : 1;
}

int benchring_make(bench_ring *ring, const bench_picture *picture, unsigned count)
{
    const size_t room = room_of_all(picture);
    memset(ring, 0, sizeof *ring);
    ring->picture = picture;
    ring->count = count;
    for (unsigned i = 0; i < count; i++) {
        if (posix_memalign(&ring->memory[i], PAGE, room) != 0) {
            ring->memory[i] = NULL;
            return say_error("bench", "out of memory for %u frames of %s", count, picture->name);
        }
        uint8_t *to = ring->memory[i];
        for (unsigned form = 0; form < BENCH_FORMS; form++) {
            memcpy(to, picture->form[form].view.plane[0], bytes_of(picture, form));
            ring->frame[form][i] = to;
            to += room_of(picture, form);
        }
    }
    return 0;
}

void benchring_free(bench_ring *ring)
{
    for (unsigned i = 0; i < BENCH_FRAMES_MAX; i++) {
        free(ring->memory[i]);
    }
    memset(ring, 0, sizeof *ring);
}
