/*
 * Private to the libcamera backend: what its files share.
 *
 * Two threads meet here. libcamera's own calls `completed` and `unplugged`, which do nothing but
 * put a note behind `lock` and ring `wake`; everything else belongs to the thread of the caller.
 */
#ifndef CAPTURE_LIBCAMERA_HPP
#define CAPTURE_LIBCAMERA_HPP

#include "backend.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <sys/types.h>

#include <libcamera/libcamera.h>

namespace capture_libcamera
{

using clock = std::chrono::steady_clock;

/*
 * A share of the process's one CameraManager: libcamera allows no second, and aborts. The first
 * share starts it and looks for cameras, the last one to go ends it.
 */
class manager_share
{
  public:
    manager_share() = default;
    manager_share(const manager_share &) = delete;
    manager_share &operator=(const manager_share &) = delete;
    ~manager_share();

    int take(); /* 0, or a negative errno: nothing was taken */
    void keep_forever();
    libcamera::CameraManager *operator->() const
    {
        return manager;
    }

  private:
    libcamera::CameraManager *manager = nullptr;
};

/* A DMA buffer in this process's memory, to read; unmapped when it goes. */
class mapping
{
  public:
    mapping(int fd, size_t length);
    mapping(mapping &&other) noexcept;
    mapping(const mapping &) = delete;
    mapping &operator=(const mapping &) = delete;
    ~mapping();

    const uint8_t *start() const
    {
        return static_cast<const uint8_t *>(address);
    } /* or NULL */
    int descriptor() const
    {
        return fd;
    }

  private:
    void *address;
    size_t length;
    int fd; /* libcamera's */
};

enum class place { idle, queued, held };

/* One buffer, its request, and who has it. */
struct slot {
    std::unique_ptr<libcamera::Request> request;
    libcamera::FrameBuffer *buffer = nullptr;
    std::vector<mapping> maps;
    const uint8_t *plane[3] = {nullptr, nullptr, nullptr};
    place where = place::idle;
    unsigned token = 0;  /* of the frame that the caller holds */
    uint64_t number = 0; /* counts the queued requests: which one this is */
};

/* Where a plane of the picture lies: in which plane of the buffer, from which byte, how many. */
struct plane_layout {
    unsigned buffer_plane;
    size_t offset_bytes;
    size_t needed_bytes;
    int32_t stride_bytes;
};

struct layout {
    unsigned planes;
    plane_layout plane[3];
};

/* A value that the caller has set, and the number of the request that carried it. */
struct asked_value {
    int32_t value;
    uint64_t carried_by;
};

struct reported_value {
    libcamera::ControlValue value;
    uint64_t number;
};

struct state {
    manager_share manager; /* first in, last out */
    std::shared_ptr<libcamera::Camera> camera;
    std::string id;
    bool acquired = false;
    std::vector<dev_t> nodes; /* the camera's device nodes, as far as libcamera says */

    std::unique_ptr<libcamera::CameraConfiguration> config;
    libcamera::StreamRole role = libcamera::StreamRole::Viewfinder;
    std::unique_ptr<libcamera::FrameBufferAllocator> allocator;
    layout planes = {};
    std::vector<slot> slots;
    std::map<unsigned, std::vector<mapping>> orphans; /* held frames of a device that went */
    int64_t frame_duration_us = 0;                    /* asked of the camera; 0: nothing */
    bool running = false;

    unsigned next_token = 1;
    unsigned first_token = 1; /* of those that are out since the last stop */
    uint64_t next_number = 1;
    bool sequence_known = false; /* a frame of this run of the stream has been seen */
    uint32_t last_sequence = 0;  /* as libcamera counts */
    uint64_t sequence = 0;       /* carried on */
    bool carry_on = false;       /* the next run goes on counting where the last one ended */
    uint64_t last_timestamp_us = 0;
    uint32_t missed = 0; /* since the last frame that was delivered */
    unsigned timeouts_in_row = 0;
    std::weak_ptr<libcamera::Camera> stranded; /* one that could not be stopped, see halt */
    bool away = false;                         /* unplugged, torn down, waiting for its return */
    bool lost = false;                         /* for good */
    clock::time_point away_since;

    std::map<unsigned, asked_value> asked;
    std::map<unsigned, reported_value> reported;

    std::mutex lock;
    std::condition_variable wake;
    std::deque<unsigned> finished; /* behind lock: slots whose requests libcamera gave back */
    bool gone = false;             /* behind lock: the camera was unplugged */

    void completed(libcamera::Request *request);
    void unplugged();
};

inline state *state_of(const capture *camera)
{
    return static_cast<state *>(camera->state);
}

/* CAPTURE_ERR_BUSY, ... for a negative errno. */
capture_status status_of(int result);

/* capture_fail with the camera's name, what was tried and the text of a negative errno. */
capture_status fail_with(capture *camera, const char *what, int result);

/* V4L2's code of one of libcamera's formats, which have DRM's; DRM's where V4L2 has none. */
uint32_t v4l2_code(const libcamera::PixelFormat &format);

/* ---- capture_libcamera_setup.cpp: negotiation ---- */
capture_status negotiate(capture *camera);
capture_status configure_again(capture *camera); /* after the camera returned: the same settings */
int modes(capture *camera, capture_mode *modes, size_t max);

/* ---- capture_libcamera.cpp ---- */
std::vector<dev_t> nodes_of(const manager_share &manager,
                            const std::shared_ptr<libcamera::Camera> &camera);

/* ---- capture_libcamera_buffers.cpp ---- */
capture_status make_slots(capture *camera); /* on failure some are left: drop_slots */
/* Requests go before the buffers that they name; mappings may stay. */
void drop_slots(state *s);
/* Where a plane starts in its DMA buffer. */
size_t offset_of(const libcamera::FrameBuffer::Plane &plane);
/* Tells the memory's owner that the processor starts or ends reading, so that caches agree with
 * what the camera wrote. Memory that needs no such care answers with an error: left at that. */
void announce(capture *camera, const slot &used, bool reading);

/* ---- capture_libcamera_stream.cpp ---- */
capture_status start(capture *camera);
capture_status stop(capture *camera);
capture_status next(capture *camera, unsigned deadline_ms, capture_frame *frame);
capture_status give_back(capture *camera, const capture_frame *frame);
void release_camera(state *s); /* stops, frees and gives the camera back, whatever its state */

/* ---- capture_libcamera_controls.cpp ---- */
int controls(capture *camera, capture_control *controls, size_t max);
capture_status menu_item(capture *camera, uint32_t id, int32_t index, char text[32]);
capture_status query(capture *camera, uint32_t id, capture_control *control);
capture_status get(capture *camera, uint32_t id, int32_t *value);
capture_status set(capture *camera, uint32_t id, int32_t value);
uint32_t known(capture *camera, capture_known known);
/* The control of that name, NULL if the camera has not got it. */
const libcamera::ControlId *find_control(const state *s, const char *name);
/* Puts into `list` what was set and no request has carried; with `all`, whatever was ever set. */
void carry_controls(state *s, libcamera::ControlList *list, uint64_t number, bool all);
void note_metadata(state *s, const libcamera::ControlList &metadata, uint64_t number);

/* Runs a body of a C function: nothing may be thrown into C. */
template <typename Body> auto guarded(capture *camera, Body &&body) -> decltype(body())
{
    const char *what = "out of memory or of threads";

    try {
        return body();
    } catch (const std::exception &) {
    } catch (...) {
        what = "unknown exception";
    }
    if (camera) {
        capture_fail(camera, CAPTURE_ERR_SYSTEM, "libcamera: %s", what);
    }
    return static_cast<decltype(body())>(CAPTURE_ERR_SYSTEM);
}

} // namespace capture_libcamera

#endif
