/* Calls nothing: linked.py asks the linker for every function that the headers declare. */
void start(void);

void start(void)
{
    for (;;) {
    }
}
