/* Cameras through libcamera: buffers of a stream, mapped and laid out. */
#include "capture_libcamera.hpp"

#include <algorithm>
#include <cerrno>

#include <linux/dma-buf.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

namespace capture_libcamera
{

mapping::mapping(int descriptor_, size_t length_)
    : address(mmap(nullptr, length_, PROT_READ, MAP_SHARED, descriptor_, 0)), length(length_),
      fd(descriptor_)
{
    if (address == MAP_FAILED) {
        address = nullptr;
    }
}

mapping::mapping(mapping &&other) noexcept
    : address(other.address), length(other.length), fd(other.fd)
{
    other.address = nullptr;
}

mapping::~mapping()
{
    if (address) {
        munmap(address, length);
    }
}

void announce(capture *camera, const slot &used, bool reading)
{
    struct dma_buf_sync sync = {};

    sync.flags = DMA_BUF_SYNC_READ | (reading ? DMA_BUF_SYNC_START : DMA_BUF_SYNC_END);
    for (const mapping &map : used.maps) {
        while (ioctl(map.descriptor(), DMA_BUF_IOCTL_SYNC, &sync) < 0 &&
               (errno == EINTR || errno == EAGAIN)) {
            camera->counts.interrupted++;
        }
    }
}

size_t offset_of(const libcamera::FrameBuffer::Plane &plane)
{
    return plane.offset == libcamera::FrameBuffer::Plane::kInvalidOffset ? 0 : plane.offset;
}

/* Maps each DMA buffer once, from its start, as far as any plane in it goes. */
static bool map_buffer(slot *filled, std::vector<const uint8_t *> *starts)
{
    const auto &planes = filled->buffer->planes();

    for (const auto &plane : planes) {
        const auto known =
            std::find_if(filled->maps.begin(), filled->maps.end(),
                         [&](const mapping &map) { return map.descriptor() == plane.fd.get(); });

        if (known == filled->maps.end()) {
            size_t length = 0;

            for (const auto &other : planes) {
                if (other.fd.get() == plane.fd.get()) {
                    length = std::max(length, offset_of(other) + other.length);
                }
            }
            filled->maps.emplace_back(plane.fd.get(), length);
            if (!filled->maps.back().start()) {
                return false;
            }
            starts->push_back(filled->maps.back().start() + offset_of(plane));
        } else {
            starts->push_back(known->start() + offset_of(plane));
        }
    }
    return true;
}

/*
 * Cameras that keep all planes in one piece may describe it as one plane of the buffer: then chroma
 * follows right behind luma. The layout is the same for every buffer of a stream.
 */
static void fold_planes(state *s, const capture_settings &settings)
{
    size_t offset = 0;

    for (unsigned i = 0; i < s->planes.planes; i++) {
        plane_layout &plane = s->planes.plane[i];
        const size_t rows = i == 0 ? settings.height : settings.height / 2U;

        plane.buffer_plane = 0;
        plane.offset_bytes = offset;
        offset += static_cast<size_t>(plane.stride_bytes) * rows;
    }
}

static capture_status fill_slot(capture *camera, slot *filled)
{
    state *const s = state_of(camera);
    const auto &planes = filled->buffer->planes();
    std::vector<const uint8_t *> starts;

    if (!map_buffer(filled, &starts)) {
        return fail_with(camera, "mmap", -errno);
    }
    if (planes.size() == 1 && s->planes.planes > 1) {
        fold_planes(s, camera->settings);
    }
    for (unsigned i = 0; i < s->planes.planes; i++) {
        const plane_layout &plane = s->planes.plane[i];

        if (plane.buffer_plane >= planes.size() ||
            plane.offset_bytes + plane.needed_bytes > planes[plane.buffer_plane].length) {
            return capture_fail(camera, CAPTURE_ERR_FORMAT,
                                "%s: a buffer is smaller than its frame", s->id.c_str());
        }
        filled->plane[i] = starts[plane.buffer_plane] + plane.offset_bytes;
    }
    return CAPTURE_OK;
}

capture_status make_slots(capture *camera)
{
    state *const s = state_of(camera);
    libcamera::Stream *const stream = s->config->at(0).stream();
    s->allocator = std::make_unique<libcamera::FrameBufferAllocator>(s->camera);
    const int result = s->allocator->allocate(stream);

    if (result < 0) {
        return fail_with(camera, "allocating buffers", result);
    }
    for (const auto &buffer : s->allocator->buffers(stream)) {
        slot made;

        made.buffer = buffer.get();
        made.request = s->camera->createRequest(s->slots.size());
        if (!made.request || made.request->addBuffer(stream, made.buffer) < 0) {
            return capture_fail(camera, CAPTURE_ERR_SYSTEM, "%s: no request can be made",
                                s->id.c_str());
        }
        const capture_status status = fill_slot(camera, &made);
        if (status != CAPTURE_OK) {
            return status;
        }
        s->slots.push_back(std::move(made));
    }
    camera->settings.buffers = static_cast<unsigned>(s->slots.size());
    return CAPTURE_OK;
}

void drop_slots(state *s)
{
    s->slots.clear();
    s->allocator.reset();
}

} // namespace capture_libcamera
