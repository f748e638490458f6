// The C headers, from C++.
#include <pel.h>
#include <cstdio>

int main()
{
    pel_blob blob = pel_blob();
    blob.area = 4;
    blob.sum_x = 6;
    blob.sum_y = 10;
    int32_t x_q16 = 0;
    int32_t y_q16 = 0;
    pel_blob_centroid_q16(&blob, &x_q16, &y_q16);
    std::printf("pel %s: centroid %ld, %ld\n", pel_version(), static_cast<long>(x_q16),
                static_cast<long>(y_q16));
    return 0;
}
