/* An empty port: it compiles, and does nothing. Copy this folder and fill the functions in, in the
 * order in which README.md goes through them. */
#include "port.h"

int port_begin(void)
{
    return PORT_READY;
}

int port_line(port_line_info *line)
{
    (void)line;
    return PORT_END;
}

int port_frame(pel_cview *view)
{
    (void)view;
    return PORT_FAILED;
}

uint32_t port_time_us(void)
{
    return 0;
}

int port_write(const uint8_t *bytes, uint32_t count)
{
    (void)bytes;
    (void)count;
    return 0;
}

int port_end(int status)
{
    return status;
}
