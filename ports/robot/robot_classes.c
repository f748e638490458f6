/* 8 classes, colour range full. Once, at the start:
 *     for (unsigned i = 0; i < robot_classes_count; i++) {
 *         pel_boxes_set(&boxes, i, &robot_classes[i]);
 *     } */
#include <pel.h>

enum { robot_classes_count = 8 };

const pel_color_box robot_classes[] = {
    {50, 215, 30, 103, 160, 230},   /* 0: orange */
    {90, 255, 0, 84, 130, 158},     /* 1: yellow */
    {30, 135, 106, 130, 152, 240},  /* 2: red */
    {30, 160, 148, 230, 60, 119},   /* 3: blue */
    {60, 140, 90, 116, 70, 104},    /* 4: field */
    {190, 255, 110, 140, 112, 140}, /* 5: line */
    {66, 100, 122, 140, 114, 135},  /* 6: wall */
    {0, 60, 120, 140, 118, 136},    /* 7: dark */
};
