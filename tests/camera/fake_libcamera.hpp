/*
 * A libcamera whose one camera does what a test says. Its classes are libcamera's own declarations;
 * fake_libcamera.cpp defines those of their functions that reach for devices, and as definitions of
 * the program they come before the library's. Made for the headers of libcamera 0.0.x.
 */
#ifndef FAKE_LIBCAMERA_HPP
#define FAKE_LIBCAMERA_HPP

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <vector>

#include <libcamera/libcamera.h>

/* What the camera is and how it answers. */
struct fake_script {
    std::map<libcamera::PixelFormat, std::vector<libcamera::SizeRange>> formats;
    libcamera::ControlInfoMap::Map controls;
    unsigned stride_step = 1; /* strides are multiples of it */
    bool one_plane = false;   /* buffers describe all planes of a picture as one */
    bool present = true;      /* the manager lists it */
    int manager_start = 0;
    int acquire = 0;
    int configure = 0;
    int allocate = 0;
    int start = 0;
    int queue = 0;
};

/* What is alive and what was done wrongly, over all objects. */
struct fake_account {
    int managers, cameras, requests, buffers;
    int acquired, running;
    int faults; /* calls in a wrong order, such as buffers that go before their requests */
    unsigned starts, stops;
};

extern fake_script script;
extern fake_account account;

/* Requests that the camera has, oldest first. */
extern std::deque<libcamera::Request *> fake_queue;
/* What libcamera was told with the last start and with the last request. */
extern std::map<unsigned, libcamera::ControlValue> fake_start_controls, fake_request_controls;

/* Finishes the oldest request; `bytes_less` than a whole frame. False if there is none. The first
 * byte of the frame is the low byte of `sequence`. */
bool fake_deliver(uint32_t sequence,
                  libcamera::FrameMetadata::Status status = libcamera::FrameMetadata::FrameSuccess,
                  unsigned bytes_less = 0, const libcamera::ControlList *metadata = nullptr);

/* Takes the camera away as libcamera does when udev says so. */
void fake_unplug();
/* Lists a new camera under the old name. */
void fake_return();

#endif
