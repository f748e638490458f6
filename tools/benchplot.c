#include "benchplot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "say.h"
#include "sink.h"
#include "text.h"

static const draw_color black = {0, 0, 0};
static const draw_color grid = {220, 220, 220};
static const draw_color orange = {235, 130, 30};

static draw_color color_of(pel_backend backend)
{
    static const draw_color colors[PEL_BACKEND_COUNT] = {
        [PEL_BACKEND_SCALAR] = {150, 160, 175}, [PEL_BACKEND_SSSE3] = {110, 170, 220},
        [PEL_BACKEND_AVX2] = {40, 110, 190},    [PEL_BACKEND_AVX512] = {60, 50, 150},
        [PEL_BACKEND_NEON] = {30, 140, 110},    [PEL_BACKEND_DSP] = {130, 180, 80},
        [PEL_BACKEND_MVE] = {60, 130, 50},
    };
    return colors[backend];
}

/* The plot at work: where things are. */
typedef struct canvas {
    const benchplot *plot;
    frame picture;
    int first, decades; /* the axis: from 10^first on */
    int32_t row_height;
} canvas;

/* ---- Places -------------------------------------------------------------------------------- */

static double smallest(const bench_figure *figure)
{
    double least = fmin(figure->own.median, figure->copy.median);
    return figure->has_opencv ? fmin(least, figure->opencv.median) : least;
}

static double largest(const bench_figure *figure)
{
    double most = fmax(figure->own.median, figure->copy.median);
    return figure->has_opencv ? fmax(most, figure->opencv.median) : most;
}

static void find_axis(canvas *on)
{
    double least = smallest(&on->plot->figures[0]);
    double most = largest(&on->plot->figures[0]);
    for (unsigned i = 1; i < on->plot->count; i++) {
        least = fmin(least, smallest(&on->plot->figures[i]));
        most = fmax(most, largest(&on->plot->figures[i]));
    }
    on->first = (int)floor(log10(least));
    const int last = (int)ceil(log10(most));
    on->decades = last > on->first ? last - on->first : 1;
}

static int32_t length_of(const canvas *on, double ns)
{
    return (int32_t)lround((log10(ns) - on->first) / on->decades * BENCHPLOT_PANEL);
}

/* Panels and rows follow the order of the figures. */
static unsigned count_panels(const benchplot *plot)
{
    unsigned panels = 1;
    for (unsigned i = 1; i < plot->count; i++) {
        panels += plot->figures[i].picture != plot->figures[i - 1].picture;
    }
    return panels;
}

static unsigned count_rows(const benchplot *plot)
{
    unsigned rows = 1;
    for (unsigned i = 1; i < plot->count && plot->figures[i].picture == plot->figures[0].picture;
         i++) {
        rows += plot->figures[i].op != plot->figures[i - 1].op;
    }
    return rows;
}

static int32_t panel_left(unsigned panel)
{
    return BENCHPLOT_LEFT + (int32_t)panel * (BENCHPLOT_PANEL + BENCHPLOT_RIGHT);
}

/* ---- Drawing ------------------------------------------------------------------------------- */

static void fill(const pel_view *picture, int32_t x, int32_t y, int32_t width, int32_t height,
                 draw_color color)
{
    for (int32_t row = 0; row < height; row++) {
        draw_line(picture, x, y + row, x + width - 1, y + row, color);
    }
}

static void draw_grid(const canvas *on, unsigned panel, unsigned rows)
{
    const pel_view *picture = &on->picture.view;
    const int32_t bottom = BENCHPLOT_TOP + (int32_t)rows * on->row_height;
    for (int i = 0; i <= on->decades; i++) {
        char label[32];
        const int32_t x = panel_left(panel) + BENCHPLOT_PANEL * i / on->decades;
        const int digits = on->first + i < 0 ? -(on->first + i) : 0;
        snprintf(label, sizeof label, "%.*f", digits, pow(10, on->first + i));
        draw_line(picture, x, BENCHPLOT_TOP, x, bottom, grid);
        const int32_t left = i == on->decades ? x - text_width(label) : x - text_width(label) / 2;
        text_draw(picture, left, BENCHPLOT_TOP - 12, label, black);
        text_draw(picture, left, bottom + 4, label, black);
    }
}

static void draw_title(const canvas *on, unsigned panel, const bench_figure *figure)
{
    const bench_picture *input = figure->picture;
    char title[100];
    char turns[32] = "";
    if (figure->frames > 1) {
        snprintf(turns, sizeof turns, ", %u copies in turn", figure->frames);
    }
    snprintf(title, sizeof title, "%.40s, %ux%u%s", input->name, (unsigned)input->width,
             (unsigned)input->height, turns);
    text_draw(&on->picture.view, panel_left(panel), BENCHPLOT_TOP - 28, title, black);
}

/* A square and a word; returns where the next one goes. */
static int32_t draw_key(const canvas *on, int32_t x, const char *word, draw_color color)
{
    fill(&on->picture.view, x, 25, 8, 8, color);
    text_draw(&on->picture.view, x + 12, 25, word, black);
    return x + 12 + text_width(word) + 14;
}

static void draw_legend(const canvas *on)
{
    char text[100];
    int32_t x = BENCHPLOT_LEFT;
    snprintf(text, sizeof text, "nanoseconds per pixel, median of %u runs", on->plot->runs);
    text_draw(&on->picture.view, 8, 8, text, black);
    for (unsigned i = 0; i < on->plot->backends.count; i++) {
        const pel_backend backend = on->plot->backends.of[i];
        x = draw_key(on, x, pel_backend_name(backend), color_of(backend));
    }
    if (on->plot->opencv) {
        snprintf(text, sizeof text, "opencv %.32s", on->plot->opencv);
        x = draw_key(on, x, text, orange);
    }
    draw_line(&on->picture.view, x, 24, x, 33, black);
    text_draw(&on->picture.view, x + 5, 25, "memcpy", black);
}

/* The place of a backend among the bars of a row. */
static unsigned lane_of(const canvas *on, pel_backend backend)
{
    unsigned lane = 0;
    while (on->plot->backends.of[lane] != backend) {
        lane++;
    }
    return lane;
}

static void draw_figure(const canvas *on, const bench_figure *figure, unsigned panel, unsigned row)
{
    const pel_view *picture = &on->picture.view;
    const int32_t left = panel_left(panel);
    const int32_t top = BENCHPLOT_TOP + (int32_t)row * on->row_height + BENCHPLOT_GAP / 2;
    const int32_t lane = (int32_t)lane_of(on, figure->backend);
    const int32_t lanes = (int32_t)on->plot->backends.count;
    if (panel == 0) {
        text_draw(picture, 8, top, figure->op->name, black);
    }
    fill(picture, left, top + lane * BENCHPLOT_BAR, length_of(on, figure->own.median) + 1,
         BENCHPLOT_BAR - 1, color_of(figure->backend));
    if (figure->has_opencv) {
        fill(picture, left, top + lanes * BENCHPLOT_BAR, length_of(on, figure->opencv.median) + 1,
             BENCHPLOT_BAR - 1, orange);
    }
    const int32_t copy = left + length_of(on, figure->copy.median);
    draw_line(picture, copy, top - 1, copy, top + on->row_height - BENCHPLOT_GAP, black);
}

static void draw_figures(const canvas *on, unsigned rows)
{
    unsigned panel = 0;
    unsigned row = 0;
    for (unsigned i = 0; i < on->plot->count; i++) {
        const bench_figure *figure = &on->plot->figures[i];
        if (i > 0 && figure->picture != figure[-1].picture) {
            panel++;
            row = 0;
        } else if (i > 0) {
            row += figure->op != figure[-1].op;
        }
        if (i == 0 || row == 0) {
            draw_grid(on, panel, rows);
            draw_title(on, panel, figure);
        }
        draw_figure(on, figure, panel, row);
    }
}

int benchplot_write(const char *path, const benchplot *plot)
{
    canvas on = {.plot = plot};
    const unsigned bars = plot->backends.count + 1u;
    const unsigned rows = count_rows(plot);
    on.row_height = BENCHPLOT_GAP + (int32_t)bars * BENCHPLOT_BAR;
    const unsigned width = (unsigned)panel_left(count_panels(plot));
    const unsigned height =
        BENCHPLOT_TOP + rows * (unsigned)on.row_height + (unsigned)BENCHPLOT_BOTTOM;
    if (frame_resize(&on.picture, PEL_RGB888, PEL_RANGE_FULL, width, height)) {
        return say_error(path, "cannot be %ux%u large", width, height);
    }
    memset(on.picture.bytes, 255, (size_t)3 * width * height);
    find_axis(&on);
    draw_legend(&on);
    draw_figures(&on, rows);
    const pel_cview drawn = pel_view_to_read(&on.picture.view);
    const int failed = sink_picture(path, &drawn, NULL);
    frame_free(&on.picture);
    return failed;
}
