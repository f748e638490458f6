/* The operations of `pel point`: what each does with a picture. cmd_point.c reads their words. */
#ifndef POINTOPS_H
#define POINTOPS_H

#include "turn.h"

typedef struct pointops_job pointops_job;

/* Turns a picture and writes it, or prepares something. 0, or -1 after a message. */
typedef int pointops_step(pointops_job *job, const char *path, const pel_cview *picture);

/* What the command line says, and the pictures in work. */
struct pointops_job {
    turn turn;
    pointops_step *look; /* makes the table from the picture; may be NULL */
    pointops_step *make;
    pel_backend backend;
    uint8_t table[256];
    int32_t contrast_milli, pivot; /* pivot: PIVOT_MEAN, or 0..255 */
    uint16_t low_permille, high_permille;
    uint8_t radius;
    int16_t c;
    unsigned width, height;
    pel_resize_method method;
    int has_patch, gray_world;
    uint16_t patch[4];
    pel_combine_op combine;
    uint16_t alpha_q8;
    char *second; /* path of the other picture */
    source *other;
    unsigned long others; /* how many of its pictures were read */
    int other_ended;      /* with one picture only: it serves for all */
    frame gray, second_raw, second_plain, first_plain, made;
};

enum { PIVOT_MEAN = -1 };

/* Tables from the picture, from its luma if it has colours. */
pointops_step pointops_look_contrast, pointops_look_stretch, pointops_look_otsu,
    pointops_look_equalize;

pointops_step pointops_table, pointops_adaptive, pointops_resize, pointops_balance,
    pointops_combine, pointops_blend, pointops_integral;

void pointops_free(pointops_job *job);

#endif
