#include "text.h"

#include <string.h>

enum { COLUMNS = 5, ROWS = 9, SHEET_LETTERS = 12, SHEETS = 4 };

/* Which letter is where below; the last stands for all others. */
static const char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789.,:-+/()%_ ?";

/* clang-format off */
static const char *const sheet[SHEETS][ROWS] = {
    {"      #               #         ##        #       #      #  #      ##  ",
     "      #               #        #          #                 #       #  ",
     " ###  ####   ###   ####  ###  ####   #### ####   ##     ##  #  #    #  ",
     "    # #   # #     #   # #   #  #    #   # #   #   #      #  # #     #  ",
     " #### #   # #     #   # #####  #    #   # #   #   #      #  ##      #  ",
     "#   # #   # #     #   # #      #    #   # #   #   #      #  # #     #  ",
     " #### ####   ###   ####  ###   #     #### #   #  ###     #  #  #   ### ",
     "                                        #             #  #             ",
     "                                     ###               ##              "},
    {"                                                                       ",
     "                                           #                           ",
     "## #  ####   ###  ####   #### # ##   #### ####  #   # #   # #   # #   #",
     "# # # #   # #   # #   # #   # ##    #      #    #   # #   # # # #  # # ",
     "# # # #   # #   # #   # #   # #      ###   #    #   # #   # # # #   #  ",
     "# # # #   # #   # #   # #   # #         #  #    #   #  # #  # # #  # # ",
     "# # # #   #  ###  ####   #### #     ####    ##   ####   #    # #  #   #",
     "                  #         #                                          ",
     "                  #         #                                          "},
    {"             ###    #    ###   ###     #  #####  ###  #####  ###   ### ",
     "            #   #  ##   #   # #   #   ##  #     #         # #   # #   #",
     "#   # ##### #  ##   #       #     #  # #  ####  #        #  #   # #   #",
     "#   #    #  # # #   #     ##    ##  #  #      # ####    #    ###   ####",
     "#   #   #   ##  #   #    #        # #####     # #   #   #   #   #     #",
     "#   #  #    #   #   #   #     #   #    #  #   # #   #   #   #   #     #",
     " #### #####  ###   ###  #####  ###     #   ###   ###    #    ###   ### ",
     "    #                                                                  ",
     " ###                                                                   "},
    {"                                  #    #   #    ##  #             #####",
     "                                 #    #     #   ##  #             #   #",
     "             ##           #      #   #       #     #              #   #",
     "             ##           #     #    #       #    #               #   #",
     "                   ###  #####  #     #       #   #                #   #",
     " ##    ##    ##           #    #      #     #   #  ##             #   #",
     " ##    ##    ##           #   #        #   #    #  ##             #####",
     "        #                                             #####            ",
     "       #                                                               "},
};
/* clang-format on */

static size_t index_of(char c)
{
    const char small = c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
    const char *found = strchr(letters, small);
    return found ? (size_t)(found - letters) : sizeof letters - 2;
}

static void draw_letter(const pel_view *picture, int32_t x, int32_t y, size_t index,
                        draw_color color)
{
    const size_t from = index % SHEET_LETTERS * TEXT_STEP;
    for (int32_t row = 0; row < ROWS; row++) {
        const char *line = sheet[index / SHEET_LETTERS][row] + from;
        for (int32_t column = 0; column < COLUMNS; column++) {
            if (line[column] == '#') {
                draw_pixel(picture, x + column, y + row, color);
            }
        }
    }
}

void text_draw(const pel_view *picture, int32_t x, int32_t y, const char *text, draw_color color)
{
    for (; *text != '\0'; text++, x += TEXT_STEP) {
        draw_letter(picture, x, y, index_of(*text), color);
    }
}

int32_t text_width(const char *text)
{
    return (int32_t)strlen(text) * TEXT_STEP;
}
