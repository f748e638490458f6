/* What the tests against a libcamera of our own share. */
#ifndef LIBCAMERA_REPLAY_HPP
#define LIBCAMERA_REPLAY_HPP

#include "capture.h"

#include "fake_libcamera.hpp"

/* Counts, and says what failed. */
__attribute__((format(printf, 2, 3))) bool check(bool good, const char *format, ...);

/* A camera of 320x240, 640x480 and 1280x720 in YUYV that does everything right. */
void reset();

capture_wish wish_of(unsigned width, unsigned height);
capture_counts counts_of(const capture *camera);

/* Random lives of a camera: every call's answer and all counts are foretold. */
void test_random(uint32_t stories);

#endif
