#include "pel/status.h"
#include "pel/version.h"

/* Text in arrays, not pointers to text: a table of pointers would be data that needs relocation. */
static const char refused[][16] = {"PEL_ERR_ARG", "PEL_ERR_FORMAT", "PEL_ERR_SPACE",
                                   "PEL_ERR_RANGE", "PEL_ERR_ORDER"};
static const char done[][16] = {"PEL_OK", "PEL_TRUNCATED"};

const char *pel_status_name(pel_status status)
{
    const int value = (int)status;

    if (value >= (int)PEL_ERR_ORDER && value <= (int)PEL_ERR_ARG) {
        return refused[-1 - value];
    }
    return value == 0 || value == 1 ? done[value] : "?";
}

const char *pel_version(void)
{
    return PEL_VERSION;
}
