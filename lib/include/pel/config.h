/*
 * Compile-time choices. The library and every file that includes its headers must agree on them:
 * the CMake target and the pkg-config file carry them along; other builds pass the same -D twice.
 */
#ifndef PEL_CONFIG_H
#define PEL_CONFIG_H

#include <stddef.h>
#include <stdint.h>

/*
 * How many colour classes a box table can hold: 8, 16 or 32. A table takes 3 x 256 masks of that
 * many bits: 768, 1536 or 3072 bytes. Results for the same classes do not depend on it.
 */
#ifndef PEL_CLASS_MAX
#define PEL_CLASS_MAX 8
#endif

/* PEL_FOR_CLASSES gives a function a name of its own for each choice, so that a program and a
 * library that do not agree fail to link instead of reading each other's tables wrongly. */
#if PEL_CLASS_MAX == 8
typedef uint8_t pel_class_mask;
#define PEL_FOR_CLASSES(name) name
#elif PEL_CLASS_MAX == 16
typedef uint16_t pel_class_mask;
#define PEL_FOR_CLASSES(name) name##_16
#elif PEL_CLASS_MAX == 32
typedef uint32_t pel_class_mask;
#define PEL_FOR_CLASSES(name) name##_32
#else
#error "PEL_CLASS_MAX must be 8, 16 or 32"
#endif

/*
 * The largest width and height of a picture, in pixels. Larger views are refused. The bounds
 * written beside accumulators assume this value; it is not meant to be raised.
 */
#define PEL_SIDE_MAX 8192

#endif
