/*
 * Bad input is refused by name and never crashes. Argument: the folder corpus/.
 *
 *   1. Every kept malformed file is refused with the words that corpus/EXPECTED says.
 *   2. Every truncation of every good file is refused, but for the rule at `least_whole`.
 *   3. 20 000 good files with a few bits flipped are read or refused, whatever they say now.
 */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "options.h"

enum { FLIPS = 20000, LEAST_CORPUS = 60, GOOD_MAX = 40, PATH_BYTES = 512 };

/* ---- The corpus ---------------------------------------------------------------------------- */

/* "source", "classes" or "raw FORMAT WIDTHxHEIGHT"; sizes that no frame can have must come
 * through. */
static int parse_how(const char *words, reading *how)
{
    char format[20];
    reading made = {0};

    if (sscanf(words, "raw %19s %ux%u", format, &made.options.width, &made.options.height) == 3) {
        made.options.raw = 1;
        if (options_format(format, &made.options.format)) {
            return -1;
        }
    } else {
        made.is_classes = strcmp(words, "classes") == 0;
        if (!made.is_classes && strcmp(words, "source") != 0) {
            return -1;
        }
    }
    *how = made;
    return 0;
}

static void check_refused(const char *folder, const char *name, const reading *how,
                          const char *fragment)
{
    char path[PATH_BYTES];
    size_t count;
    uint8_t *bytes;

    snprintf(path, sizeof path, "%s/%s", folder, name);
    bytes = load(path, &count);
    if (!bytes) {
        return;
    }
    check(read_bytes(path, bytes, count, how) == -1, "%s was read", name);
    check(strstr(last_message, fragment) != NULL, "%s: '%s' does not say '%s'", name, last_message,
          fragment);
    free(bytes);
}

static unsigned check_corpus(const char *folder)
{
    char path[PATH_BYTES], line[PATH_BYTES];
    unsigned files = 0;
    FILE *list;

    snprintf(path, sizeof path, "%s/EXPECTED", folder);
    list = fopen(path, "r");
    if (!list) {
        check(0, "cannot read %s", path);
        return 0;
    }
    while (fgets(line, sizeof line, list)) {
        char *rest = NULL;
        const char *name = strtok_r(line, "\t\n", &rest);
        const char *words = strtok_r(NULL, "\t\n", &rest);
        const char *fragment = strtok_r(NULL, "\t\n", &rest);
        reading how;
        if (check(fragment && parse_how(words, &how) == 0,
                  "EXPECTED: a line that is not understood")) {
            check_refused(folder, name, &how, fragment);
            files++;
        }
    }
    fclose(list);
    return files;
}

/* How many files the corpus has, so that none is forgotten in EXPECTED. */
static unsigned count_files(const char *folder)
{
    static const char *const kinds[] = {"pnm", "y4m", "raw", "png", "jpeg", "classes", "tm"};
    unsigned files = 0;
    size_t i;

    for (i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        char path[PATH_BYTES];
        struct dirent *entry;
        DIR *dir;
        snprintf(path, sizeof path, "%s/%s", folder, kinds[i]);
        dir = opendir(path);
        if (!check(dir != NULL, "cannot list %s", path)) {
            continue;
        }
        while ((entry = readdir(dir)) != NULL) {
            files += entry->d_name[0] != '.';
        }
        closedir(dir);
    }
    return files;
}

/* ---- Good files, cut and bent -------------------------------------------------------------- */

typedef struct good_file {
    char name[100];
    uint8_t *bytes;
    size_t count;
    reading how;
} good_file;

static int ends_with(const char *name, const char *ending)
{
    size_t length = strlen(name), tail = strlen(ending);

    return length >= tail && strcmp(name + length - tail, ending) == 0;
}

static unsigned load_good(const char *folder, good_file *files)
{
    char path[PATH_BYTES];
    struct dirent *entry;
    unsigned count = 0;
    DIR *dir;

    snprintf(path, sizeof path, "%s/good", folder);
    dir = opendir(path);
    if (!check(dir != NULL, "cannot list %s", path)) {
        return 0;
    }
    while ((entry = readdir(dir)) != NULL && count < GOOD_MAX) {
        good_file *file = &files[count];
        if (entry->d_name[0] == '.') {
            continue;
        }
        snprintf(file->name, sizeof file->name, "%.99s", entry->d_name);
        snprintf(path, sizeof path, "%s/good/%s", folder, file->name);
        file->how.is_classes = ends_with(file->name, ".classes") || ends_with(file->name, ".tm");
        file->bytes = load(path, &file->count);
        count += file->bytes != NULL;
    }
    closedir(dir);
    return count;
}

/*
 * A text file cut within its very end can still be whole, and is then read: a plain PNM from the
 * first digit of its last sample on (fewer digits are another number, which nobody can tell), a
 * class file from the last ')' on. All others need their last byte.
 */
static size_t least_whole(const good_file *file)
{
    size_t n = file->count;

    if (file->bytes[0] == 'P' && (file->bytes[1] == '2' || file->bytes[1] == '3')) {
        while (n > 0 && strchr(" \n", file->bytes[n - 1])) {
            n--;
        }
        while (n > 1 && file->bytes[n - 2] >= '0' && file->bytes[n - 2] <= '9') {
            n--;
        }
    } else if (ends_with(file->name, ".classes")) {
        while (n > 0 && file->bytes[n - 1] != ')') {
            n--;
        }
    }
    return n;
}

static unsigned long check_truncations(const good_file *file)
{
    size_t whole = least_whole(file), n;

    for (n = 0; n <= file->count; n++) {
        int result = read_bytes(file->name, file->bytes, n, &file->how);
        check(n < whole ? result == -1 : result == 1, "%s cut to %zu of %zu bytes: %d, %s",
              file->name, n, file->count, result, last_message);
    }
    return file->count;
}

static uint64_t next_random(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state >> 16;
}

/* Returns what read_bytes said. One bit in half of the cases, up to eight in the others. */
static int check_flipped(const good_file *file, uint64_t *state)
{
    uint8_t *bent = malloc(file->count);
    uint64_t flips = next_random(state) % 2 ? 1 : 1 + next_random(state) % 8;
    int result;

    if (!bent) {
        abort();
    }
    memcpy(bent, file->bytes, file->count);
    for (; flips > 0; flips--) {
        uint64_t bit = next_random(state) % (8 * file->count);
        bent[bit / 8] = (uint8_t)(bent[bit / 8] ^ (1u << (bit % 8)));
    }
    result = read_bytes(file->name, bent, file->count, &file->how);
    free(bent);
    return result;
}

static void check_flips(const good_file *files, unsigned count)
{
    uint64_t state = 20240229;
    unsigned refused = 0, i;

    for (i = 0; i < FLIPS; i++) {
        refused += check_flipped(&files[i % count], &state) < 0;
    }
    printf("%d files with flipped bits: %u refused, %u read\n", FLIPS, refused, FLIPS - refused);
    check(refused > FLIPS / 10 && refused < FLIPS, "%u of %d refused is not to be believed",
          refused, FLIPS);
}

int main(int argc, char **argv)
{
    static good_file files[GOOD_MAX];
    unsigned kept, listed, count, i;
    unsigned long cuts = 0;

    if (argc != 2) {
        fprintf(stderr, "usage: %s CORPUS\n", argv[0]);
        return 2;
    }
    kept = count_files(argv[1]);
    listed = check_corpus(argv[1]);
    check(kept == listed && kept >= LEAST_CORPUS, "%u files kept, %u listed", kept, listed);
    printf("%u malformed files\n", listed);
    count = load_good(argv[1], files);
    check(count >= 10, "only %u good files", count);
    for (i = 0; i < count; i++) {
        cuts += check_truncations(&files[i]);
    }
    printf("%lu truncations of %u good files\n", cuts, count);
    if (count > 0) {
        check_flips(files, count);
    }
    for (i = 0; i < count; i++) {
        free(files[i].bytes);
    }
    return finish();
}
