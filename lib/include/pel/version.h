/* The version. This is the only place that states it: CMake and the packages read it from here. */
#ifndef PEL_VERSION_H
#define PEL_VERSION_H

#define PEL_VERSION_MAJOR 0
#define PEL_VERSION_MINOR 1
#define PEL_VERSION_PATCH 0
#define PEL_VERSION "0.1.0"

#ifdef __cplusplus
extern "C" {
#endif

/* The version that the library was compiled as, to compare with PEL_VERSION. Static text. */
const char *pel_version(void);

#ifdef __cplusplus
}
#endif

#endif
