/*
 * BlobFinder: finds coloured blobs in a picture of 160 x 120 while its lines arrive, and prints them
 * to the serial monitor (115200 baud). There is no frame buffer: the memory is one line of pixels,
 * one line of labels, two lines of runs and the blobs that are open, which leaves an Arduino Mega
 * more than 2 of its 8 KiB.
 *
 * In place of a camera, next_line() draws a small map from flash, four pixels for each letter. Put
 * there what reads a line (YUYV, 320 bytes) from your camera.
 */
#include <pel.h>

static const uint16_t WIDTH = 160, HEIGHT = 120, OPEN_MAX = 16;
static const uint8_t RESULTS_MAX = 4;

/* o an orange ball, b a blue goal, y a yellow cone, everything else the floor. */
static const char MAP[30][41] PROGMEM = {
    "........................................",
    "........................................",
    "..bbbbbbbbbbbbbb........................",
    "..bbbbbbbbbbbbbb........................",
    "..bb..........bb........................",
    "..bb..........bb...........y............",
    "..bb..........bb...........y............",
    "..bb..........bb..........yyy...........",
    "..bb..........bb..........yyy...........",
    "..bb..........bb.........yyyyy..........",
    ".........................yyyyy..........",
    "........................yyyyyyy.........",
    "........................yyyyyyy.........",
    "........................................",
    "........................................",
    "........oo..............................",
    "......oooooo............................",
    ".....oooooooo...........................",
    ".....oooooooo...........................",
    "....oooooooooo......................b...",
    "....oooooooooo.....................b....",
    ".....oooooooo.......................b...",
    ".....oooooooo...........................",
    "......oooooo............................",
    "........oo..............................",
    "...................................yyyyy",
    "...................................yyyyy",
    "...................................yyyyy",
    "........................................",
    "o......................................o",
};

static const char *const NAMES[] = {"ball", "goal", "cone"};

/* What a class is: from..to of Y, of U and of V. */
static const pel_color_box BALL = {80, 255, 0, 110, 160, 255};
static const pel_color_box GOAL = {30, 200, 150, 255, 0, 125};
static const pel_color_box CONE = {120, 255, 0, 90, 100, 155};

static uint8_t line[2 * WIDTH];
static uint8_t labels[WIDTH];
static uint64_t work[PEL_BLOBS_WORDS(WIDTH, OPEN_MAX, 0)];
static pel_blob results[RESULTS_MAX];
static pel_boxes boxes;
static pel_classifier classifier;
static pel_blobs blobs;

/* Line y of the picture in YUYV, as a camera sends it. */
static void next_line(uint16_t y)
{
    for (uint16_t x = 0; x < WIDTH; x += 2) {
        const char what = (char)pgm_read_byte(&MAP[y / 4][x / 4]);
        uint8_t *const pair = line + 2 * x;
        pair[0] = pair[2] = what == 'o' ? 150 : what == 'b' ? 70 : what == 'y' ? 200 : 90;
        pair[1] = what == 'o' ? 70 : what == 'b' ? 190 : what == 'y' ? 40 : 128;
        pair[3] = what == 'o' ? 190 : what == 'b' ? 100 : what == 'y' ? 140 : 128;
    }
}

static void print_blob(const char *what, const pel_blob *blob)
{
    int32_t x_q16, y_q16;

    pel_blob_centroid_q16(blob, &x_q16, &y_q16);
    Serial.print(what);
    Serial.print(NAMES[blob->class_index]);
    Serial.print(F(" area "));
    Serial.print(blob->area);
    Serial.print(F(" centre "));
    Serial.print(x_q16 / 65536.0, 2);
    Serial.print(' ');
    Serial.print(y_q16 / 65536.0, 2);
    Serial.print(F(" box "));
    Serial.print(blob->x0);
    Serial.print(' ');
    Serial.print(blob->x1);
    Serial.print(' ');
    Serial.print(blob->y0);
    Serial.print(' ');
    Serial.println(blob->y1);
}

/* Called the moment that a blob is complete, long before the picture ends. */
static void on_blob(void *, const pel_blob *blob)
{
    print_blob("closed: ", blob);
}

/* One picture; the answer is that of the first call that refused, or of the last one. */
static pel_status find_blobs(uint32_t *count)
{
    pel_blobs_config config = pel_blobs_config();
    pel_status status;

    config.width = WIDTH;
    config.height = HEIGHT;
    config.open_max = OPEN_MAX;
    config.work = work;
    config.work_bytes = sizeof work;
    config.results = results;
    config.results_max = RESULTS_MAX;
    config.on_blob = on_blob;
    status = pel_blobs_begin(&blobs, &config);
    for (uint16_t y = 0; y < HEIGHT && status >= 0; y++) {
        const pel_crow row = pel_crow_packed(line, PEL_YUYV, PEL_RANGE_FULL, WIDTH);
        next_line(y);
        status = pel_blobs_pixels(&blobs, y, &classifier, &row, labels);
    }
    return status < 0 ? status : pel_blobs_end(&blobs, count);
}

void setup()
{
    Serial.begin(115200);
    pel_boxes_set(&boxes, 0, &BALL);
    pel_boxes_set(&boxes, 1, &GOAL);
    pel_boxes_set(&boxes, 2, &CONE);
    classifier.boxes = &boxes;
    classifier.range = PEL_RANGE_FULL;
}

void loop()
{
    uint32_t count = 0;
    const pel_status status = find_blobs(&count);

    for (uint32_t i = 0; i < count; i++) {
        print_blob("largest: ", &results[i]);
    }
    Serial.print(F("frame done: "));
    Serial.print(pel_status_name(status));
    Serial.print(F(", found "));
    Serial.println(blobs.counts.found);
    delay(1000);
}
